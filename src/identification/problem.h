#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "estimation/optimisation.h"
#include "identification/progress_phases.h"
#include "inspection/following.h"
#include "model/linear_model.h"

namespace uncertainty_identification {

/// The input of one identification, apart from the experiments.
struct Request {
  Configuration configuration;
  NominalModelFactory nominal_model;   ///< empty: the model that the configuration names
  ProgressCallback progress;           ///< may be empty
  const Estimate* previous = nullptr;  ///< the estimate to start from; null: none
};

/// Experiments that passed the checks, and those that did not.
struct CheckedData {
  std::vector<Experiment> experiments;
  std::vector<Block> blocks;
  std::vector<RejectedExperiment> rejected;
  int thinning = 1;           ///< each so manieth sample was kept (EstimationOptions)
  bool single_steps = false;  ///< whether every input changes only once
  bool are_cut =
      false;  ///< to what follows the first measured output, as they do not begin at rest
  bool has_strays = false;  ///< readings that count as missing (data/stray_readings.h)
  Following following;      ///< how input and output follow each other

  int count() const { return static_cast<int>(experiments.size()); }
  double sampleTime() const { return experiments.front().sample_time; }  ///< [s]
  long validSamples() const;
  int movedInputs() const;  ///< number of experiments whose input is not constant
};

/// Go fitted to its free simulation, before H and the error model are.
struct FittedPlant {
  Polynomials polynomials;
  double offset = 0;
  ModelParameters point;  ///< of the output-error model that was fitted
  std::vector<ParameterEstimate> parameters{};
  Eigen::MatrixXd covariance{};             ///< of `parameters`
  Eigen::MatrixXd coordinate_covariance{};  ///< of plantCoordinates()
};

/// The input of the steps of an identification. A step that chooses something returns its choice;
/// the next step gets a problem that contains it.
struct Problem {
  const CheckedData& data;
  NominalModelFactory nominal_model;  ///< as in Request
  const Estimate* previous;           ///< as in Request
  Configuration configuration;        ///< `auto` is replaced by what was chosen so far
  std::optional<FittedPlant> plant;   ///< fitted to its simulation and fixed; else none
  Eigen::VectorXd start;              ///< a start of the model's parameters; empty: none
  /// Where the choice of the structure has arrived, with one component; its parameters are `start`.
  std::optional<ModelParameters> reached{};
  Eigen::MatrixXd points{};  ///< that it is linearised about there, a column for each experiment
};

/// The record that all steps add to.
struct Journal {
  ProgressPhases progress;
  std::vector<Candidate> candidates{};  ///< tried by the automatic choices
  std::vector<std::string> warnings{};
  int passes = 0;  ///< sweeps over all samples
};

/// The model of the whole problem at the highest likelihood that was found.
struct FittedModel {
  std::unique_ptr<LinearModel> model;  ///< linearised about the posterior means where need be
  std::unique_ptr<Likelihood> likelihood;
  int components = kAutomatic;  ///< of the mixture, as chosen; automatic where `initial` gives one
  Eigen::MatrixXd floor;        ///< least covariance of a component, see covarianceFloor()
  Optimum optimum;
};

/// Options of an optimisation whose iterations are reported as progress of `phase`.
OptimisationOptions optimisationOptions(const Configuration& configuration, Phase phase,
                                        ProgressPhases* progress);

/// The nominal model that the request or its configuration names.
std::shared_ptr<const NominalModel> nominalModelOf(const Problem& problem);

/// The same, or, once the plant is fitted, the noise model around the fixed plant.
std::shared_ptr<const NominalModel> remainingNominalModel(const Problem& problem);

/// The model to be fitted, with the error model and the effects of the configuration. Where it is
/// only locally linear it is linearised about zero.
std::unique_ptr<LinearModel> buildModel(const Problem& problem);

/// The likelihood of the problem's data. The model must outlive it.
std::unique_ptr<Likelihood> likelihoodOf(const Problem& problem, const LinearModel& model);

}  // namespace uncertainty_identification
