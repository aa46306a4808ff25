#include "explanation/search_outcome.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/unmeasured_start.h"
#include "estimation/excerpt.h"
#include "explanation/estimate_fit.h"
#include "explanation/feedback_check.h"
#include "explanation/input_steps.h"
#include "explanation/residual_checks.h"
#include "explanation/spectral_peaks.h"
#include "explanation/undamped_poles.h"
#include "explanation/verdict.h"
#include "explanation/warnings.h"
#include "explanation/wording.h"
#include "identification/steps.h"
#include "math/information_criterion.h"
#include "model/sensitivity.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The model of the estimate, optimised by the search's own fit, as the state before any cause.
/// Throws DataError where it cannot be evaluated.
SearchState baseOf(const Estimate& estimate, const Split& data, const FitContext& context) {
  std::vector<Experiment> held = data.held;
  std::vector<std::string> not_told;
  if (mayStartAnywhere(estimate.configuration.estimation, data.train))
    held = fromFirstMeasured(std::move(held), &not_told);
  SearchState base{{}, FitData(usedBy(estimate, data.train)), FitData(std::move(held)), {}, {}};
  base.fitted_to = data.fitted_to;
  const Fit fit = fitOf(estimate, base.train, summarise(base.train.experiments()));
  base.fit = optimise(fit, base.train, context);
  if (!std::isfinite(base.fit.log_likelihood))
    throw DataError(
        "the identified model cannot be evaluated on the experiments that it was identified from, "
        "as where a pole is at the edge of stability; state smaller orders (nominal_model), or "
        "record longer");
  return base;
}

/// What the catalogue of effects is made for: the data, and the residuals of the base.
/// `may_move_in_steps`: whether these may come from an actuator that does, as findInputSteps()
/// says.
DataSummary summaryOf(const SearchState& base, bool* may_move_in_steps) {
  const NominalModel& nominal = base.fit.model->nominal();
  DataSummary summary = summarise(base.train.experiments());
  summary.regressors = base.fit.model->regressors();
  summary.plant_parameters =
      plantParameters(nominal, base.fit.at.parameters.head(nominal.parameterCount()));
  const Residuals residuals = residualsOf(base.fit, base.train);
  findSpectralPeaks(residuals, base.train, &summary);
  *may_move_in_steps = findInputSteps(residuals, base.fit, base.train, &summary);
  return summary;
}

/// Excludes all effects but those named and users' own.
void excludeOthers(const std::vector<std::string>& named, const Effects& effects,
                   const DataSummary& summary, std::vector<std::string>* excluded) {
  const std::vector<std::string> own = registeredNames(summary);
  for (const auto& effect : effects)
    if (!contains(named, effect->name()) && !contains(own, effect->name()))
      excluded->push_back(effect->name());
}

/// Accepts the causes that the samples show without a model. Quantisation is accepted only if it is
/// most of the noise: a smaller step is told, and explains nothing.
void addCausesThatSamplesShow(const std::vector<SpoiltSamples>& spoilt, const Effects& effects,
                              SearchState* base) {
  constexpr double kMost = 0.5, kNoticeable = 0.05;  // variance of rounding / sigma^2
  for (const SpoiltSamples& each : spoilt) {
    if (each.trait == Trait::quantisation) {
      const double step = each.parameters.front().value;
      const double share = step * step / 12 / base->fit.at.noise_variance;
      if (share <= kMost) {
        if (share > kNoticeable) base->remark = quantisationRemark(step, share);
        continue;
      }
      base->law = ResidualLaw::of_steps;
    }
    const HeldOut held = heldOut(base->fit, base->held);
    FoundCause cause;
    cause.effect = findEffect(effects, each.trait);
    cause.parameters = each.parameters;
    cause.gain = gainOf(held, held, base->gains(base->fit, base->fit));
    base->causes.push_back(std::move(cause));
    const Effect& effect = *base->causes.back().effect;
    base->banned.push_back(effect.name());
    const std::vector<std::string>& excluded = effect.description().excludes;
    base->banned.insert(base->banned.end(), excluded.begin(), excluded.end());
  }
}

/// Whether the residuals hold what the input did before.
bool dependsOnInput(const SearchState& state) {
  for (const Check& check : checkResiduals(state.fit, state.train, state.law))
    if (check.name == "dependence on the input") return !check.passed;
  return false;
}

/// Accepts feedback as a cause (exp_feedback) if its test says so. Where the residuals depend on
/// the earlier input, an input that is predictable over a long time correlates with them a little
/// without any feedback: it has to be overwhelming.
void addFeedback(const Effects& effects, SearchState* base, SearchState* found) {
  constexpr double kFeedback = 1e-4, kOverwhelming = 1e-20;  // p-value
  constexpr double kMuch = 0.1;  // share of what is new in the input; many samples make less of it
                                 // significant without a loop
  const FeedbackTest test = testFeedback(residualsOf(found->fit, found->train), found->train);
  if (test.p_value >= kFeedback) return;
  const bool is_overwhelming = test.p_value < kOverwhelming && test.share > kMuch;
  if (!is_overwhelming && dependsOnInput(*found)) {
    if (base->remark.empty()) base->remark = kMayBeFeedback;
    return;
  }
  FoundCause cause;
  cause.effect = findEffect(effects, Trait::feedback);
  found->causes.push_back(std::move(cause));
}

/// Whether the model with the causes found so far describes the data.
bool describesAll(const SearchState& state) {
  return allPassed(checkResiduals(state.fit, state.train, state.law));
}

/// The causes that the curves name, and another one of the whole catalogue beside them, if all
/// tests pass with it. If they do not, it may be a symptom of what the model cannot contain, and so
/// may those that would follow it.
SearchState withAnother(SearchState found, const ExplanationOptions& options,
                        const FitContext& context, const Effects& effects) {
  if (describesAll(found) || !context.going_on()) return found;
  SearchState more = Search(options, context, effects).withAnother(found);
  return describesAll(more) ? more : found;
}

/// Whether causes hold a line of the spectrum which the model of `other` has as poles that nothing
/// damps within an experiment, and make the data about as likely: it comes from outside. Damping
/// that the data show, however little, is that of a resonance.
bool hasLineAsPolesOf(const SearchOutcome& outcome, const SearchOutcome& other) {
  constexpr double kShare = 0.03, kAsLikely = 3;  // of the oscillation; [nats]
  if (outcome.penalisedLikelihood() < other.penalisedLikelihood() - kAsLikely) return false;
  const ExtendedModel& model = *outcome.found.fit.model;
  const double longest = longestOf(other.base.train.experiments());
  for (std::size_t k = 0; k < model.effects().size(); ++k) {
    const Effect& effect = *model.effects()[k];
    const std::vector<EffectParameter>& parameters = effect.description().parameters;
    const auto frequency =
        std::find_if(parameters.begin(), parameters.end(),
                     [](const EffectParameter& each) { return each.name == "frequency"; });
    if (!effect.has(Trait::spectral_line) || frequency == parameters.end()) continue;
    const double value =
        model.psi(outcome.found.fit.at.parameters, k)[frequency - parameters.begin()];
    const NominalModelEstimate& poles = other.estimate.nominal_model;
    if (hasUndampedPoles(poles, value * poles.sample_time, longest, kShare)) return true;
  }
  return false;
}

}  // namespace

double SearchOutcome::penalisedLikelihood() const {
  const double parameters = base.fit.model->nominal().parameterCount();
  return base.fit.log_likelihood - bicPenalty(parameters, base.train.samples()) + found.total;
}

bool SearchOutcome::explainsAll() const {
  return describesAll(found) &&
         std::any_of(found.causes.begin(), found.causes.end(), isInEveryExperiment);
}

std::vector<SearchOutcome> outcomesOf(const std::vector<Estimate>& candidates,
                                      const Estimate& chosen,
                                      const std::function<SearchOutcome(const Estimate&)>& search,
                                      const std::function<bool()>& in_time) {
  std::vector<SearchOutcome> outcomes;
  for (const Estimate& candidate : candidates) {
    try {
      outcomes.push_back(search(candidate));
      outcomes.back().chosen_orders = orderText(chosen);
    } catch (const DataError&) {
      if (outcomes.empty() && &candidate == &candidates.back()) throw;
      continue;
    }
    const SearchState& first = outcomes.front().found;
    const bool is_answer = !first.causes.empty() && describesAll(first) &&
                           undampedFrequency(outcomes.front().estimate.nominal_model,
                                             longestOf(first.train.experiments())) == 0;
    if (!in_time() || is_answer) break;
  }
  return outcomes;
}

AnswerLikelihood likelihoodOf(const SearchOutcome& outcome) {
  const SearchState& found = outcome.found;
  AnswerLikelihood likelihood;
  const auto is_of_plant = [](const FoundCause& cause) {
    return isInEveryExperiment(cause) && !cause.effect->has(Trait::spectral_line);
  };
  if (std::none_of(found.causes.begin(), found.causes.end(), is_of_plant)) return {};
  for (const FoundCause& cause : found.causes) {
    if (isOfNoise(*cause.effect)) return {};
    if (cause.score > 0 && !cause.may_be_order) likelihood.causes.push_back(cause.effect->name());
  }
  likelihood.training = outcome.penalisedLikelihood();
  likelihood.samples = found.train.samples();
  if (!found.fitted_to)
    likelihood.held_out = evaluateOn(found.fit, found.held).log_likelihood / found.held.count();
  return likelihood;
}

FitContext contextOf(const Estimate& estimate, std::uint64_t seed) {
  FitContext context;
  context.options.constraint = estimate.configuration.error_model.constraint;
  if (estimate.error_model.mixture.components() > 0)
    context.options.floor = covarianceFloor(estimate.error_model.mixture);
  context.seed = seed;
  context.going_on = [] { return true; };
  context.report_searched = [](double) {};
  context.report_fitted = [](const std::string&) {};
  return context;
}

SearchOutcome searchOnTopOf(ExplanationOptions options, const FitContext& context,
                            Estimate estimate, const Split& data,
                            const std::vector<SpoiltSamples>& spoilt,
                            const std::vector<std::string>& only) {
  SearchState base = baseOf(estimate, data, context);
  bool may_move_in_steps = false;
  const DataSummary summary = summaryOf(base, &may_move_in_steps);
  const Effects effects = catalogue(summary);
  addCausesThatSamplesShow(spoilt, effects, &base);
  const bool tests_feedback =
      !contains(options.exclude, findEffect(effects, Trait::feedback)->name());
  const ExplanationOptions whole = options;
  if (!only.empty()) excludeOthers(only, effects, summary, &options.exclude);
  Search search(options, context, effects);
  // The error of a coarse quantisation is neither Gaussian nor white, and hides other effects.
  const bool of_steps = base.law == ResidualLaw::of_steps;
  SearchState found = of_steps ? base : search.run(base);
  if (!of_steps && !only.empty() && !found.causes.empty())
    found = withAnother(std::move(found), whole, context, effects);
  if (tests_feedback) addFeedback(effects, &base, &found);
  SearchOutcome outcome{std::move(estimate), std::move(base), std::move(found), search.tried(),
                        search.refusals()};
  outcome.may_move_in_steps = may_move_in_steps;
  return outcome;
}

SearchOutcome* bestOf(std::vector<SearchOutcome>* outcomes, double acceptance) {
  const auto worth = [acceptance](const SearchOutcome& of) {
    return of.penalisedLikelihood() - acceptance * static_cast<double>(of.found.causes.size());
  };
  SearchOutcome* const best =
      &*std::max_element(outcomes->begin(), outcomes->end(),
                         [&](const SearchOutcome& left, const SearchOutcome& right) {
                           return worth(left) < worth(right);
                         });
  const auto with_line =
      std::find_if(outcomes->begin(), outcomes->end(),
                   [best](const SearchOutcome& other) { return hasLineAsPolesOf(other, *best); });
  if (with_line == outcomes->end() || &*with_line == best) return best;
  with_line->chosen_orders = orderText(with_line->estimate);
  with_line->simplification = kLineAsPoles;
  return &*with_line;
}

}  // namespace uncertainty_identification
