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

/// The log density of the last thirds given the rest, and the share of their squares that a
/// simulation leaves.
struct OnLast {
  double log_density = 0, error = 0;
};

OnLast onLast(const Fit& fit, const FitData& whole, const FitData& first, const FitData& last,
              const FitContext& context) {
  const Fit fitted = optimise(evaluated(fit.model, fit.at, first), first, context);
  const double left = 1 - heldOut(fitted, last).nrmse_fit_percent / 100;
  return {evaluateOn(fitted, whole).log_likelihood - evaluateOn(fitted, first).log_likelihood,
          left * left};
}

}  // namespace

std::optional<LastThirds> gainOnLastThirds(const SearchState& base, const SearchState& found,
                                           const FitContext& context) {
  if (!found.fitted_to || found.causes.empty()) return std::nullopt;
  const FitData& whole = found.train;
  const FitData first = masked(whole.experiments(), true),
                last = masked(whole.experiments(), false);
  const OnLast without = onLast(base.fit, whole, first, last, context),
               with = onLast(found.fit, whole, first, last, context);
  const LastThirds gains{with.log_density - without.log_density, with.error / without.error};
  if (!std::isfinite(gains.log_density) || !std::isfinite(gains.error_ratio) || !context.going_on())
    return std::nullopt;
  return gains;
}

}  // namespace uncertainty_identification
