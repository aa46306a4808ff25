#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "estimation/least_squares_start.h"
#include "estimation/simulation_fit.h"
#include "identification/steps.h"
#include "model/fixed_plant.h"

/// Whether initial states must be estimated. Where experiments start at rest, unknown initial
/// values with a wide prior would cost likelihood with each further state of the model, and the
/// smaller of two structures would be chosen for that alone.
namespace uncertainty_identification {
namespace {

/// The second-order model whose simulation the first samples are compared with.
LeastSquaresModel simpleModel(const std::vector<Experiment>& experiments,
                              const EstimationOptions& options, LeastSquaresStart::Start state) {
  constexpr int kOrder = 2, kMostSamples = 20000, kLongestDelay = 20;
  std::vector<const Experiment*> all;
  int shortest = experiments.front().samples();
  for (const Experiment& experiment : experiments) {
    all.push_back(&experiment);
    shortest = std::min(shortest, experiment.samples());
  }
  const LeastSquaresStart start(all, constantOf(options.offsets), kMostSamples);
  return start.steiglitzMcBride(kOrder, kOrder, 0, std::min(kLongestDelay, shortest / 4), state);
}

/// Simulation errors from an initial state, of one model or of a model for each experiment.
std::vector<Eigen::VectorXd> errorsFrom(InitialState state,
                                        const std::vector<LeastSquaresModel>& models,
                                        EstimationOptions options,
                                        const std::vector<Experiment>& experiments) {
  options.initial_state = state;
  const auto of = [&](const LeastSquaresModel& model, const std::vector<Experiment>& some) {
    return simulationErrors(*fixPlant(model.polynomials, 0, 0), Eigen::VectorXd(0), model.offset,
                            options, some);
  };
  if (models.size() == 1) return of(models.front(), experiments);
  std::vector<Eigen::VectorXd> errors;
  for (std::size_t r = 0; r < experiments.size(); ++r)
    errors.push_back(of(models[r], {experiments[r]}).front());
  return errors;
}

/// Mean square of the errors at measured samples: of the first ones of each experiment, or of all.
/// Larger squares count as `most`.
double meanSquare(const std::vector<Eigen::VectorXd>& errors,
                  const std::vector<Experiment>& experiments, int first, double most) {
  double squares = 0, count = 0;
  for (std::size_t r = 0; r < errors.size(); ++r) {
    for (int k = 0, measured = 0; k < errors[r].size() && measured < first; ++k) {
      if (!experiments[r].isValid(k)) continue;
      ++measured;
      ++count;
      squares += std::min(errors[r][k] * errors[r][k], most);
    }
  }
  return squares / std::max(count, 1.0);
}

/// Whether the errors of the first samples, if all experiments start at rest, are as small as all
/// others. None where the models explain too little to tell.
std::optional<bool> looksAtRest(const std::vector<LeastSquaresModel>& models,
                                const EstimationOptions& options,
                                const std::vector<Experiment>& experiments) {
  constexpr int kFirst = 4, kAll = std::numeric_limits<int>::max();
  constexpr double kMostUnexplained = 0.25;  // of the variance of the outputs
  constexpr double kLargest = 9;  // squares relative to the mean; noise may have heavy tails
  constexpr double kSlack = 0.25, kDeviations = 1.5;  // of a mean of one square per experiment
  const double usual = meanSquare(errorsFrom(InitialState::estimate, models, options, experiments),
                                  experiments, kAll, std::numeric_limits<double>::infinity());
  if (!(usual < kMostUnexplained * outputVariance(experiments))) return {};
  const double at_rest = meanSquare(errorsFrom(InitialState::zero, models, options, experiments),
                                    experiments, kFirst, kLargest * usual);
  const double margin = kSlack + kDeviations / std::sqrt(static_cast<double>(experiments.size()));
  return at_rest < (1 + margin) * usual;
}

/// Experiments, twenty at most, with a model of each one's own.
struct OwnModels {
  std::vector<Experiment> experiments;
  std::vector<LeastSquaresModel> models;
};

OwnModels ownModels(const std::vector<Experiment>& experiments, const EstimationOptions& options) {
  constexpr std::size_t kEnough = 20;
  OwnModels own;
  for (std::size_t r = 0; r < experiments.size();
       r += (experiments.size() + kEnough - 1) / kEnough) {
    own.experiments.push_back(experiments[r]);
    own.models.push_back(simpleModel({experiments[r]}, options, LeastSquaresStart::Start::unknown));
  }
  return own;
}

}  // namespace

bool levelsAtRestDiffer(const std::vector<Experiment>& experiments,
                        const EstimationOptions& options) {
  constexpr double kFar = 4;  // of the variance
  const OwnModels own = ownModels(experiments, options);
  const double usual = meanSquare(
      errorsFrom(InitialState::estimate, own.models, options, own.experiments), own.experiments,
      std::numeric_limits<int>::max(), std::numeric_limits<double>::infinity());
  Eigen::ArrayXd levels(static_cast<Eigen::Index>(own.experiments.size()));
  for (std::size_t r = 0; r < own.experiments.size(); ++r) {
    const Experiment& experiment = own.experiments[r];
    int first = 0;
    while (first + 1 < experiment.samples() && !experiment.isValid(first)) ++first;
    levels[static_cast<Eigen::Index>(r)] = experiment.y[first];
  }
  const double freedom = std::max(1.0, static_cast<double>(levels.size()) - 1);
  return (levels - levels.mean()).square().sum() / freedom > kFar * usual;
}

bool startAtRest(const std::vector<Experiment>& experiments, const EstimationOptions& options) {
  constexpr std::size_t kFewest = 3;
  if (experiments.size() < kFewest) return false;
  const auto together = looksAtRest(
      {simpleModel(experiments, options, LeastSquaresStart::Start::rest)}, options, experiments);
  if (together) return *together;
  // Where plants differ much, a model of each experiment's own tells what a common one cannot.
  const OwnModels own = ownModels(experiments, options);
  return own.experiments.size() >= kFewest &&
         looksAtRest(own.models, options, own.experiments).value_or(false);
}

bool mayStartAnywhere(const EstimationOptions& options,
                      const std::vector<Experiment>& experiments) {
  if (options.initial_state != InitialState::automatic)
    return options.initial_state == InitialState::estimate;
  const bool all_from_first =
      std::all_of(experiments.begin(), experiments.end(),
                  [](const Experiment& experiment) { return experiment.isValid(0); });
  return !all_from_first && !startAtRest(experiments, options);
}

}  // namespace uncertainty_identification
