#include <algorithm>

#include "data/experiment_checks.h"
#include "data/stray_readings.h"
#include "data/thinning.h"
#include "data/unmeasured_start.h"
#include "identification/steps.h"
#include "inspection/closed_loop.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// Who states orders, effects or a sample time in samples means those of the data.
int thinningOf(const Configuration& configuration, const std::vector<Experiment>& experiments) {
  constexpr int kFewest = 100;  // samples of half the experiments
  // Samples; resonances with little power, ten times as fast as the most, still get ten a period.
  constexpr double kPerPeriod = 100;
  if (configuration.estimation.thinning != kAutomatic) return configuration.estimation.thinning;
  if (!configuration.nominal_model.orders_auto || configuration.sample_time > 0 ||
      !configuration.effects.empty())
    return 1;
  std::vector<int> lengths;
  lengths.reserve(experiments.size());
  for (const Experiment& experiment : experiments) lengths.push_back(experiment.samples());
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return std::clamp(*middle / kFewest, 1, thinningByBandwidth(experiments, kPerPeriod));
}

}  // namespace

CheckedData checkData(const Configuration& configuration,
                      const std::vector<Experiment>& experiments, Journal* journal) {
  journal->progress.report(Phase::check, 0);
  std::vector<std::string> covariates;
  for (const SignalOptions& covariate : configuration.covariates)
    covariates.push_back(covariate.name);
  const CheckReport checked =
      checkExperiments(experiments, configuration.limits, covariates, configuration.sample_time);
  journal->warnings = checked.warnings;
  CheckedData data;
  data.rejected = checked.rejected;
  data.single_steps = checked.single_steps;
  for (int r : checked.usable) data.experiments.push_back(experiments[static_cast<std::size_t>(r)]);
  if (data.experiments.empty())
    throw DataError(experiments.empty()
                        ? "no experiments were given"
                        : "no usable experiment is left:" + reasonsOf(checked.rejected));
  const StrayReadings stray = strayReadings(data.experiments, configuration.limits.max_stray);
  if (stray.count > 0) journal->warnings.push_back(strayText(stray, data.experiments));
  data.has_strays = stray.count > 0;
  data.experiments = without(stray, std::move(data.experiments));
  data.following = followingOf(data.experiments);
  if (auto warning = closedLoopWarning(data.following, "the input", "the output"))
    journal->warnings.push_back(std::move(*warning));
  data.thinning = thinningOf(configuration, data.experiments);
  data.experiments = thinned(std::move(data.experiments), data.thinning);
  // Effects may count the time from the first sample, or remember inputs for longer than Go does.
  data.are_cut =
      configuration.effects.empty() && mayStartAnywhere(configuration.estimation, data.experiments);
  if (data.are_cut)
    data.experiments = fromFirstMeasured(std::move(data.experiments), &journal->warnings);
  data.blocks = makeBlocks(data.experiments);
  return data;
}

Configuration limitErrorModel(Configuration configuration, int experiments, Journal* journal) {
  constexpr int kFewest = 4;  // number of experiments that a mixture needs
  ErrorModelOptions& options = configuration.error_model;
  const bool stated =
      configuration.initial.mixture.components() > 0 || !configuration.effects.empty();
  if (options.basis == BasisKind::automatic && (stated || options.taps == 0))
    options.basis = BasisKind::fir;
  if (options.taps == 0) options.components = 1;
  if (experiments >= kFewest || options.taps == 0) return configuration;
  if (experiments == 1) {
    options.basis = BasisKind::fir;
    options.taps = 0;
    options.components = 1;
    options.constraint = Constraint::free;
    journal->warnings.push_back(
        "one experiment cannot show how the plant varies: a nominal model without error model was "
        "identified; record more experiments to estimate its uncertainty");
  } else if (options.components != 1) {
    options.components = 1;
    journal->warnings.push_back(
        std::to_string(experiments) +
        " experiments are too few for a mixture: one Gaussian component was identified; a mixture "
        "needs at least 4 experiments, better 20");
  }
  return configuration;
}

}  // namespace uncertainty_identification
