#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "estimation/climb.h"
#include "estimation/parametrisation.h"
#include "model/linear_model.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// One run of Identifier: each step leaves its findings in the estimate.
class Identification {
 public:
  /// `nominal_model` empty: the model that the configuration names.
  Identification(const Configuration& configuration, const NominalModelFactory& nominal_model,
                 const ProgressCallback& progress);

  Estimate run(const std::vector<Experiment>& experiments,
               const std::vector<Experiment>& validation, const Estimate* previous);

  /// Only the nominal plant, from an earlier estimate on: what a fold needs, without the errors of
  /// the parameters.
  FoldModel plant(const std::vector<Experiment>& experiments, const Estimate& previous);

 private:
  void checkData(const std::vector<Experiment>& experiments);
  void limitErrorModel();
  void chooseOrders();
  void fitPlant(const Estimate* previous);
  void describePlant(const LinearModel& model, const Likelihood& likelihood,
                     const ModelParameters& at);
  void chooseNoiseOrders();
  void chooseTaps();
  void buildModel();
  void checkSizes() const;
  std::vector<Eigen::VectorXd> starts() const;
  Eigen::VectorXd withEffects(const Eigen::VectorXd& start) const;
  Eigen::VectorXd given(const LinearModel& model, const Estimate* previous) const;
  bool isGiven(const Estimate* previous) const;
  std::shared_ptr<const NominalModel> nominalModel() const;
  ModelParameters start(const Estimate* previous);
  ModelParameters givenMixture(const Mixture& mixture, const Eigen::VectorXd& at,
                               const Estimate* previous) const;
  ModelParameters chooseComponents(const ModelParameters& single, const ClimbOptions& options);
  void climb(const ModelParameters& start);
  void climbOnce(ClimbOptions options);
  void adopt(std::unique_ptr<LinearModel> model);
  void settle();
  void climbToStandingPoints(const ClimbOptions& options);
  void describe();
  void describeExperiments();
  void describeParameters();
  void describeEffect(ParameterEstimate parameter, std::size_t dot);
  Eigen::MatrixXd jointCovariance(const Eigen::MatrixXd& coordinate_covariance) const;
  void reportFloor(const Eigen::MatrixXd& floor);
  void validate(const std::vector<Experiment>& validation);

  ClimbOptions climbOptions(const std::string& phase, double from, double to);
  bool report(const std::string& phase, double fraction, double log_likelihood);
  int threads() const;

  NominalModelFactory factory_;
  ProgressCallback progress_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  bool cancelled_ = false;
  double fraction_ = 0;        ///< reported last
  bool plant_only_ = false;    ///< nothing is asked for but Go
  bool choose_noise_ = false;  ///< the orders of C and D are still to be chosen
  double sample_time_ = 0;
  Estimate estimate_;                    ///< its configuration is the one being completed
  std::vector<Experiment> experiments_;  ///< those that passed the checks
  std::vector<Block> blocks_;
  std::shared_ptr<const NominalModel> nominal_;
  std::unique_ptr<LinearModel> model_;
  std::unique_ptr<Likelihood> likelihood_;
  ModelParameters at_;
  Eigen::MatrixXd points_;  ///< that the model is linearised about, where it is so only locally
  std::optional<Polynomials> plant_;  ///< Go where it is fitted to its simulation
  double plant_offset_ = 0;
  std::vector<ParameterEstimate> plant_parameters_;
  Eigen::MatrixXd plant_covariance_;             ///< of plant_parameters_
  Eigen::MatrixXd plant_coordinate_covariance_;  ///< of plantCoordinates()
};

}  // namespace uncertainty_identification
