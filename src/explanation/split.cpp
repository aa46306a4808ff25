#include "explanation/split.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <string>

#include "data/experiment_checks.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// Positions of the held-out experiments. std::shuffle is not used because its order differs
/// between standard libraries.
std::set<std::size_t> drawn(const Configuration& configuration, std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 random(configuration.estimation.seed);
  for (std::size_t k = count - 1; k > 0; --k) std::swap(order[k], order[random() % (k + 1)]);
  const double share = configuration.explanation.validation_share;
  const auto held =
      std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(count)));
  return {order.begin(), order.begin() + static_cast<std::ptrdiff_t>(held)};
}

/// Leaves the unusable ones of `experiments` out; those `beside` them are used as well.
/// `sample_time` [s]; 0: that of most of these experiments.
void leaveOut(const Configuration& configuration, double sample_time, const std::string& purpose,
              const std::vector<Experiment>& beside, std::vector<Experiment>* experiments,
              std::vector<RejectedExperiment>* rejected) {
  std::vector<std::string> covariates;
  for (const SignalOptions& covariate : configuration.covariates)
    covariates.push_back(covariate.name);
  const CheckReport checked =
      checkExperiments(*experiments, configuration.limits, covariates, sample_time, beside);
  if (checked.usable.empty())
    throw DataError(experiments->empty() ? "no experiments were given"
                                         : "no usable experiment is left " + purpose + ":" +
                                               reasonsOf(checked.rejected));
  std::vector<Experiment> usable;
  for (const int k : checked.usable)
    usable.push_back(std::move((*experiments)[static_cast<std::size_t>(k)]));
  *experiments = std::move(usable);
  rejected->insert(rejected->end(), checked.rejected.begin(), checked.rejected.end());
}

}  // namespace

std::vector<RejectedExperiment> leaveOutUnusable(const Configuration& configuration, Split* data) {
  std::vector<RejectedExperiment> rejected;
  leaveOut(configuration, configuration.sample_time, "to fit to", {}, &data->train, &rejected);
  if (data->fitted_to)
    data->held = data->train;
  else
    leaveOut(configuration, data->train.front().sample_time, "to hold out", data->train,
             &data->held, &rejected);
  return rejected;
}

Split split(const Configuration& configuration, const std::vector<Experiment>& experiments,
            const std::vector<Experiment>& validation) {
  constexpr std::size_t kFewest = 4;
  if (!validation.empty()) return {experiments, validation, false};
  if (experiments.size() < kFewest) return {experiments, experiments, true};
  const std::set<std::size_t> held = drawn(configuration, experiments.size());
  Split parts;
  for (std::size_t k = 0; k < experiments.size(); ++k)
    (held.count(k) > 0 ? parts.held : parts.train).push_back(experiments[k]);
  return parts;
}

Split splitUsable(const Configuration& configuration, const std::vector<Experiment>& experiments,
                  const std::vector<Experiment>& validation,
                  std::vector<RejectedExperiment>* rejected) {
  if (!validation.empty()) {
    Split data = split(configuration, experiments, validation);
    *rejected = leaveOutUnusable(configuration, &data);
    return data;
  }
  // Before the draw, which might hold out nothing but what is of no use.
  std::vector<Experiment> usable = experiments;
  leaveOut(configuration, configuration.sample_time, "to fit to", {}, &usable, rejected);
  return split(configuration, usable, {});
}

}  // namespace uncertainty_identification
