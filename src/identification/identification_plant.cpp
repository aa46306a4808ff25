#include <limits>

#include "estimation/excerpt.h"
#include "estimation/initial_guess.h"
#include "estimation/plant_coordinates.h"
#include "estimation/selection.h"
#include "estimation/standard_errors.h"
#include "identification/identification.h"
#include "model/held_plant.h"

/// Go fitted to its free simulation (nominal_model.fit: simulation), before H and the error model.
namespace uncertainty_identification {

using Eigen::Index;
using Eigen::VectorXd;

void Identification::fitPlant(const Estimate* previous) {
  const Configuration& configuration = estimate_.configuration;
  if (configuration.nominal_model.fit != PlantFit::simulation) return;
  NominalModelOptions options = configuration.nominal_model;
  options.structure = Structure::output_error;
  ErrorModelOptions none;
  none.taps = 0;
  const LinearModel model(makeNominalModel(options, sample_time_), ErrorBasis(none),
                          configuration.estimation);
  blocks_ = makeBlocks(experiments_);
  const Likelihood likelihood(model, blocks_, estimate_.experiment_count, threads());
  const std::vector<VectorXd> from = isGiven(previous)
                                         ? std::vector<VectorXd>{given(model, previous)}
                                         : nominalStarts(model, options, experiments_);
  const ClimbOptions climbing = climbOptions("fitting the simulation", 0.5, 0.58);
  const ModelParameters start = bestSingleComponent(likelihood, from, climbing);
  const Climb climb = maximumLikelihood(likelihood, start, climbing);
  const Index own = model.nominal().parameterCount();
  plant_ = model.nominal().polynomials(climb.at.parameters.head(own));
  plant_offset_ = climb.at.parameters.size() > own ? climb.at.parameters[own] : 0.0;
  estimate_.passes += likelihood.passes();
  if (plant_only_) return;
  describePlant(model, likelihood, climb.at);
  if (choose_noise_) chooseNoiseOrders();
}

/// The errors of Go's parameters.
void Identification::describePlant(const LinearModel& model, const Likelihood& likelihood,
                                   const ModelParameters& at) {
  const Index own = model.nominal().parameterCount();
  const int before = likelihood.passes();
  const Parametrisation parametrisation(model, Constraint::free, 1, Eigen::MatrixXd(0, 0));
  const StandardErrors errors = standardErrors(likelihood, parametrisation, at);
  for (const std::string& sentence : errors.singular) estimate_.warnings.push_back(sentence);
  const std::vector<std::string> names = model.names();
  for (Index k = 0; k < own; ++k) {
    plant_parameters_.push_back({names[static_cast<std::size_t>(k)], "", at.parameters[k],
                                 std::sqrt(errors.covariance(k, k)),
                                 std::sqrt(errors.robust_covariance(k, k))});
  }
  plant_covariance_ = errors.covariance.topLeftCorner(own, own);
  // the residual of a simulation is not white: the sandwich form is the honest one, where there is
  // one
  const Eigen::MatrixXd& covariance = likelihood.experiments() > parametrisation.size()
                                          ? errors.robust_coordinate_covariance
                                          : errors.coordinate_covariance;
  const Eigen::MatrixXd J = plantCoordinatesJacobian(model.nominal(), at.parameters.head(own));
  plant_coordinate_covariance_ = J * covariance.topLeftCorner(own, own) * J.transpose();
  estimate_.passes += likelihood.passes() - before;
}

FoldModel Identification::plant(const std::vector<Experiment>& experiments,
                                const Estimate& previous) {
  plant_only_ = true;
  checkData(experiments);
  limitErrorModel();
  fitPlant(&previous);
  if (!plant_) {
    buildModel();
    checkSizes();
    climb(start(&previous));
    const Index own = model_->nominal().parameterCount();
    plant_ = model_->nominal().polynomials(at_.parameters.head(own));
    plant_offset_ = at_.parameters.size() > own ? at_.parameters[own] : 0.0;
  }
  return {plant_->delay, plant_->b, plant_->a, plant_offset_};
}

/// C and D by BIC around the plant.
void Identification::chooseNoiseOrders() {
  const Configuration& configuration = estimate_.configuration;
  NominalModelOptions& options = estimate_.configuration.nominal_model;
  ErrorModelOptions none;
  none.taps = 0;
  const std::vector<Experiment> experiments = thinned(experiments_, kEnoughSamples);
  const std::vector<Block> blocks = makeBlocks(experiments);
  double lowest = std::numeric_limits<double>::infinity();
  int chosen = 0;
  const std::size_t first = estimate_.candidates.size();
  for (int order = 0; order <= kLargestNoiseOrder; ++order) {
    const LinearModel model(holdPlant(*plant_, order, order), ErrorBasis(none),
                            configuration.estimation);
    const Likelihood likelihood(model, blocks, static_cast<int>(experiments.size()), threads());
    const ModelParameters at = bestSingleComponent(
        likelihood, noiseStarts(model, *plant_, plant_offset_, experiments), ClimbOptions());
    if (at.mixture.components() == 0) continue;
    const Statistics statistics = likelihood.statistics(at.parameters, false);
    const double reached = likelihood.expect(statistics, at).total();
    const int parameters = model.parameterCount() + 1;
    const double criterion = bic(reached, parameters, 0, statistics.samples().sum(), 1);
    const std::string count = std::to_string(order);
    estimate_.candidates.push_back({"noise orders", "nc=" + count + " nd=" + count, parameters,
                                    reached, criterion, std::numeric_limits<double>::quiet_NaN(),
                                    false});
    if (criterion < lowest) {
      lowest = criterion;
      chosen = order;
    }
    if (!report("choosing orders", 0.58, reached)) break;
  }
  for (std::size_t k = first; k < estimate_.candidates.size(); ++k) {
    estimate_.candidates[k].chosen = estimate_.candidates[k].bic == lowest;
  }
  options.structure = chosen == 0 ? Structure::output_error : Structure::box_jenkins;
  options.nc = options.nd = chosen;
}

}  // namespace uncertainty_identification
