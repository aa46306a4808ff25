#include "explanation/last_thirds.h"

#include <cmath>
#include <utility>

#include "explanation/measure.h"
#include "explanation/refine.h"

namespace uncertainty_identification {
namespace {

/// The experiments with the outputs of their last thirds or of the rest as not measured.
FitData masked(std::vector<Experiment> experiments, bool masks_last) {
  for (Experiment& experiment : experiments) {
    const int samples = experiment.samples(), last = samples - samples / 3;
    if (experiment.valid.empty()) experiment.valid.assign(static_cast<std::size_t>(samples), 1);
    for (int k = masks_last ? last : 0; k < (masks_last ? samples : last); ++k)
      experiment.valid[static_cast<std::size_t>(k)] = 0;
  }
  return FitData(std::move(experiments));
}

/// The log density of the first two thirds, of the last thirds given these, and the share of the
/// last's squares that a simulation leaves.
struct OnParts {
  double first = 0, last = 0, error = 0;
};

OnParts onParts(const Fit& fit, const FitData& whole, const FitData& first, const FitData& last,
                const FitContext& context) {
  const Fit fitted = optimise(evaluated(fit.model, fit.at, first), first, context);
  const double left = 1 - heldOut(fitted, last).nrmse_fit_percent / 100;
  const double of_first = evaluateOn(fitted, first).log_likelihood;
  return {of_first, evaluateOn(fitted, whole).log_likelihood - of_first, left * left};
}

}  // namespace

std::optional<LastThirds> gainOnLastThirds(const SearchState& base, const SearchState& found,
                                           const FitContext& context) {
  if (!found.fitted_to || found.causes.empty()) return std::nullopt;
  const FitData& whole = found.train;
  const FitData first = masked(whole.experiments(), true),
                last = masked(whole.experiments(), false);
  const OnParts without = onParts(base.fit, whole, first, last, context),
                with = onParts(found.fit, whole, first, last, context);
  const LastThirds gains{with.last - without.last, with.first - without.first,
                         with.error / without.error};
  if (!std::isfinite(gains.log_density) || !std::isfinite(gains.error_ratio) || !context.going_on())
    return std::nullopt;
  return gains;
}

}  // namespace uncertainty_identification
