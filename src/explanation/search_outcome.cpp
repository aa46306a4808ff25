#include "explanation/search_outcome.h"

#include <algorithm>
#include <cmath>

#include "explanation/estimate_fit.h"
#include "explanation/feedback_check.h"
#include "explanation/spectral_peaks.h"
#include "model/sensitivity.h"

namespace uncertainty_identification {
namespace {

SearchState baseOf(const Estimate& estimate, const Split& data, const FitContext& context) {
  SearchState base{{}, FitData(usedBy(estimate, data.train)), FitData(data.held), {}, {}};
  base.fitted_to = data.fitted_to;
  const Fit fit = fitOf(estimate, base.train, summarise(base.train.experiments()));
  base.fit = optimise(fit, base.train, context);
  return base;
}

Effects catalogueFor(const SearchState& base) {
  const NominalModel& nominal = base.fit.model->nominal();
  DataSummary summary = summarise(base.train.experiments());
  summary.regressors = base.fit.model->regressors();
  summary.plant_parameters =
      plantParameters(nominal, base.fit.at.parameters.head(nominal.parameterCount()));
  findSpectralPeaks(residualsOf(base.fit, base.train), base.train, &summary);
  return catalogue(summary);
}

/// Causes that the samples show by themselves; a lattice only where it is coarse against the noise.
void addCausesThatSamplesShow(const std::vector<SpoiltSamples>& spoilt, const Effects& effects,
                              SearchState* base) {
  constexpr double kCoarse = 0.2;  // variance of rounding / sigma^2
  for (const SpoiltSamples& each : spoilt) {
    if (each.name == "sens_quant") {
      const double step = each.parameters.front().value;
      base->quantised = step * step / 12 > kCoarse * base->fit.at.noise_variance;
      if (!base->quantised) continue;
    }
    const HeldOut held = heldOut(base->fit, base->held);
    FoundCause cause;
    cause.effect = findEffect(effects, each.name, "");
    cause.parameters = each.parameters;
    cause.gain = gainOf(held, held, base->gains(base->fit, base->fit));
    base->causes.push_back(std::move(cause));
    base->banned.push_back(each.name);
  }
  base->heavy_tails = base->quantised;
}

void addFeedback(const Effects& effects, SearchState* found) {
  constexpr double kFeedback = 1e-4;
  if (feedbackProbability(residualsOf(found->fit, found->train), found->train) >= kFeedback) return;
  FoundCause cause;
  cause.effect = findEffect(effects, "exp_feedback", "");
  found->causes.push_back(std::move(cause));
}

}  // namespace

double SearchOutcome::merit() const {
  const double parameters = base.fit.model->nominal().parameterCount();
  return base.fit.log_likelihood - 0.5 * parameters * std::log(base.train.samples()) + found.total;
}

FitContext contextOf(const Estimate& estimate, std::uint64_t seed) {
  FitContext context;
  context.options.constraint = estimate.configuration.error_model.constraint;
  if (estimate.error_model.mixture.components() > 0)
    context.options.floor = covarianceFloor(estimate.error_model.mixture);
  context.seed = seed;
  context.going_on = [] { return true; };
  context.report_searched = [](double) {};
  return context;
}

SearchOutcome searchOnTopOf(const ExplanationOptions& options, const FitContext& context,
                            Estimate estimate, const Split& data,
                            const std::vector<SpoiltSamples>& spoilt) {
  SearchState base = baseOf(estimate, data, context);
  const Effects effects = catalogueFor(base);
  addCausesThatSamplesShow(spoilt, effects, &base);
  Search search(options, context, effects);
  // the error of a coarse lattice is neither Gaussian nor white: what else is wrong would drown in
  // it
  SearchState found = base.quantised ? base : search.run(base);
  const auto& excluded = options.exclude;
  if (std::find(excluded.begin(), excluded.end(), "exp_feedback") == excluded.end())
    addFeedback(effects, &found);
  return {std::move(estimate), std::move(base), std::move(found), search.tried()};
}

}  // namespace uncertainty_identification
