#include <algorithm>
#include <cmath>

#include "estimation/exchanged_zeros.h"
#include "estimation/finalists.h"
#include "estimation/initial_guess.h"
#include "identification/steps.h"

/// A local optimum is left by moves that a climb cannot make: to another mixture, to zeros of B and
/// of the error model that have changed places, and across the samples that a dead time spans.
namespace uncertainty_identification {
namespace {

/// The point with the mixture fitted anew, and its log-likelihood. One sweep.
Finalist withMixtureFitted(const Likelihood& likelihood, ModelParameters point,
                           OptimisationOptions options) {
  constexpr int kIterations = 50;
  options.floor = covarianceFloor(point.mixture);
  const Statistics statistics = likelihood.statistics(point.parameters, false);
  const double reached = fitMixture(likelihood, statistics, options, kIterations, 1e-2, &point);
  return {std::move(point), reached};
}

/// The best other mixture for the same plant and noise, out of more draws than the start could
/// afford to make for each number of components; also where the climb has lost a component. One
/// sweep.
void addOtherMixture(const Problem& problem, const Likelihood& likelihood,
                     const ModelParameters& at, int components, OptimisationOptions options,
                     std::vector<Finalist>* others) {
  constexpr int kTimes = 4;
  if (components < 2) return;
  ModelParameters single = at;
  single.mixture = {{1.0}, {at.mixture.mean()}, {at.mixture.covariance()}};
  options.floor = covarianceFloor(single.mixture);
  const EstimationOptions& estimation = problem.configuration.estimation;
  Finalist other;
  other.point = spreadComponents(likelihood, likelihood.statistics(at.parameters, false), single,
                                 components, kTimes * estimation.restarts, estimation.seed + 1,
                                 options, &other.log_likelihood);
  others->push_back(std::move(other));
}

/// Index of a parameter of the continuous structure; -1 if the model does not have it.
Eigen::Index indexOf(const LinearModel& model, const std::string& name) {
  if (model.nominal().structure() != "continuous") return -1;
  const std::vector<std::string> names = model.nominal().names();
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : found - names.begin();
}

/// The point with another dead time, and the same with a time constant or a zero that makes up for
/// the change: to first order they act by their sum and their difference.
std::vector<ModelParameters> withDeadTime(const LinearModel& model, const ModelParameters& at,
                                          double dead_time) {
  const Eigen::Index k = indexOf(model, "dead_time");
  const double change = dead_time - at.parameters[k];
  ModelParameters point = at;
  point.parameters[k] = dead_time;
  if (!model.admissible(point.parameters)) return {};
  std::vector<ModelParameters> points{point};
  const std::vector<std::string> names = model.nominal().names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool lags = names[i].rfind("tau", 0) == 0, leads = names[i].rfind("zero", 0) == 0;
    if (!lags && !leads) continue;
    ModelParameters other = point;
    other.parameters[static_cast<Eigen::Index>(i)] += lags ? -change : change;
    if (model.admissible(other.parameters)) points.push_back(std::move(other));
  }
  return points;
}

/// The likelihood bends where the dead time crosses a sample, and a climb may end there; between
/// two samples the error model's mean may make up for another dead time. Adds a few points within
/// this and each of the neighbouring sample intervals. One sweep for each.
void addOtherDeadTimes(const LinearModel& model, double sample_time, const Likelihood& likelihood,
                       const ModelParameters& at, const OptimisationOptions& options,
                       std::vector<Finalist>* others) {
  const Eigen::Index k = indexOf(model, "dead_time");
  if (k < 0) return;
  const double here = std::floor(at.parameters[k] / sample_time);
  for (const double interval : {here - 1, here, here + 1}) {
    for (const double fraction : {0.1, 0.5, 0.9}) {
      for (ModelParameters& point : withDeadTime(model, at, (interval + fraction) * sample_time))
        others->push_back(withMixtureFitted(likelihood, std::move(point), options));
    }
  }
}

/// Adds points with zeros of B and of the error model exchanged, where these are not far below the
/// optimum. One sweep for each.
void addExchangedZeros(const LinearModel& model, const Likelihood& likelihood,
                       const Optimum& optimum, const OptimisationOptions& options,
                       std::vector<Finalist>* others) {
  constexpr double kFar = 100;  // [nats]
  for (ModelParameters& point : withExchangedZeros(model, optimum.point, options.constraint)) {
    Finalist other = withMixtureFitted(likelihood, std::move(point), options);
    if (other.log_likelihood > optimum.log_likelihood - kFar) others->push_back(std::move(other));
  }
}

}  // namespace

std::optional<ModelParameters> higherElsewhere(const Problem& problem, const FittedModel& fitted,
                                               const OptimisationOptions& options) {
  constexpr double kHigher = 0.01;  // [nats]
  constexpr int kTurns = 5;
  const Likelihood& likelihood = *fitted.likelihood;
  const Optimum& optimum = fitted.optimum;
  std::vector<Finalist> others;
  addOtherMixture(problem, likelihood, optimum.point, fitted.components, options, &others);
  addExchangedZeros(*fitted.model, likelihood, optimum, options, &others);
  addOtherDeadTimes(*fitted.model, problem.data.sampleTime(), likelihood, optimum.point, options,
                    &others);
  if (others.empty()) return {};
  others.push_back({optimum.point, optimum.log_likelihood});
  const std::vector<Finalist> reached = climbTogether(likelihood, others, options, kTurns);
  if (reached.empty() || reached.front().log_likelihood < optimum.log_likelihood + kHigher)
    return {};
  return reached.front().point;
}

}  // namespace uncertainty_identification
