#include <algorithm>
#include <cmath>

#include "estimation/least_squares_start.h"
#include "identification/steps.h"
#include "model/sensitivity.h"

/// What structure: continuous needs besides the other structures.
namespace uncertainty_identification {
namespace {

using Eigen::Index;

/// The whole samples of dead time with which least squares explain the data best.
int scannedDeadTime(const Problem& problem, const NominalModelOptions& options) {
  const int order = options.time_constants + 2 * options.resonances;
  std::vector<const Experiment*> all;
  int shortest = problem.data.experiments.front().samples();
  for (const Experiment& experiment : problem.data.experiments) {
    all.push_back(&experiment);
    shortest = std::min(shortest, experiment.samples());
  }
  const int longest = std::min(options.max_delay, shortest / 3);
  const LeastSquaresStart pooled(all, constantOf(problem.configuration.estimation.offsets));
  const LeastSquaresModel best =
      pooled.steiglitzMcBride(order + 1, order, options.delay, options.delay + longest);
  return std::max(0, best.polynomials.delay - options.delay);
}

/// The dead time [s] in a given start or estimate; 0 where there is none.
double givenDeadTime(const Problem& problem) {
  if (problem.previous != nullptr) {
    for (const ParameterEstimate& parameter : problem.previous->nominal_model.parameters)
      if (parameter.name == "dead_time") return parameter.value;
    return 0;
  }
  const Eigen::VectorXd& theta = problem.configuration.initial.theta;
  const std::vector<std::string> names = nominalModelOf(problem)->names();
  const Index k = std::find(names.begin(), names.end(), "dead_time") - names.begin();
  return k < theta.size() ? theta[k] : 0;
}

}  // namespace

Configuration limitDeadTime(const Problem& problem) {
  constexpr int kMargin = 3;  // [samples]
  Configuration limited = problem.configuration;
  NominalModelOptions& options = limited.nominal_model;
  if (problem.nominal_model || options.structure != Structure::continuous || !options.dead_time)
    return limited;
  const auto samples = [&](double dead_time) {
    return static_cast<int>(std::min(dead_time / problem.data.sampleTime(), 1e6));
  };
  const auto fixed = options.fixed.find("dead_time");
  const int needed = fixed != options.fixed.end()
                         ? samples(fixed->second) + 1
                         : std::max(scannedDeadTime(problem, options) + kMargin,
                                    samples(givenDeadTime(problem)) + 1);
  options.max_delay = std::min(options.max_delay, needed);
  return limited;
}

ModelParameters withSortedTimeConstants(const LinearModel& model, const ErrorModelOptions& errors,
                                        ModelParameters point) {
  if (model.nominal().structure() != "continuous" || variesParameters(errors.basis)) return point;
  const std::vector<std::string> names = model.nominal().names();
  std::vector<Index> at;
  std::vector<double> values;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (names[k].compare(0, 3, "tau") != 0) continue;
    at.push_back(static_cast<Index>(k));
    values.push_back(point.parameters[at.back()]);
  }
  std::sort(values.begin(), values.end());
  for (std::size_t k = 0; k < at.size(); ++k) point.parameters[at[k]] = values[k];
  return point;
}

}  // namespace uncertainty_identification
