#include "explanation/search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "explanation/acceptance.h"
#include "explanation/bootstrap.h"
#include "explanation/confidence.h"
#include "explanation/gains.h"
#include "explanation/residual_checks.h"
#include "math/information_criterion.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

bool isAmong(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

}  // namespace

bool SearchState::has(const std::string& name) const {
  return std::any_of(causes.begin(), causes.end(),
                     [&](const FoundCause& cause) { return cause.effect->name() == name; });
}

bool SearchState::excludes(const Effect& effect) const {
  return std::any_of(causes.begin(), causes.end(), [&](const FoundCause& cause) {
    return isAmong(cause.effect->description().excludes, effect.name()) ||
           isAmong(effect.description().excludes, cause.effect->name());
  });
}

PairedGains SearchState::gains(const Fit& before, const Fit& after) const {
  PairedGains gains{logDensities(after, held) - logDensities(before, held), {}};
  if (!fitted_to) gains.training = after.of_experiments - before.of_experiments;
  return gains;
}

Search::Search(const ExplanationOptions& options, FitContext context, Effects catalogue)
    : options_(options), context_(std::move(context)), catalogue_(std::move(catalogue)) {}

double Search::threshold(const Effect& effect) const {
  const double least = effect.description().least_score;
  return least > 0 ? least : options_.acceptance;
}

bool Search::isWanted(const Effect& effect, const SearchState& state) const {
  const std::string& name = effect.name();
  return !isAmong(options_.exclude, name) && !isAmong(state.banned, name) && !state.has(name);
}

Effects Search::considered(const SearchState& state) const {
  constexpr int kFewest = 3;  // experiments that show how something differs
  Effects effects;
  for (const auto& effect : catalogue_) {
    if (effect->stage() == Stage::data || !isWanted(*effect, state) || state.excludes(*effect))
      continue;
    if (effect->has(Trait::by_experiment) && state.train.count() < kFewest) continue;
    if (effect->description().starts.empty()) continue;  // the residuals do not show it
    effects.push_back(effect);
  }
  return effects;
}

std::vector<FittedEffect> Search::rank(const SearchState& state) {
  constexpr double kUsual = 3;  // rankings, after which half of the search is reported as done
  context_.report_searched(rankings_ / (rankings_ + kUsual));
  ++rankings_;
  const bool checks_pass = allPassed(checkResiduals(state.fit, state.train, state.law));
  std::vector<FittedEffect> ranked =
      fittedEffects(state.fit, state.train, considered(state), context_, checks_pass);
  // Effects outside the chain of signals, which are fitted in ways of their own.
  const auto outside = [&](Trait trait) {
    const auto effect = findEffect(catalogue_, trait);
    return isWanted(*effect, state) ? effect : nullptr;
  };
  if (const auto mode = outside(Trait::new_component))
    ranked.push_back(oneMoreComponent(state.fit, state.train, mode, context_));
  const ResidualDistribution distribution =
      residualDistribution(state.fit, state.train, residualsOf(state.fit, state.train));
  const auto addDistribution = [&](Trait trait, double gain, int parameters) {
    constexpr double kSelection = 2;  // [nats] for the choice among several distributions
    const auto effect = outside(trait);
    const double penalty = bicPenalty(parameters, state.train.samples()) + kSelection;
    if (effect) ranked.push_back({effect, state.fit, penalty, gain - penalty, {}, false});
  };
  addDistribution(Trait::heavy_tails, distribution.student_gain, 1);
  addDistribution(Trait::outliers, distribution.readingsGain(), 2);
  sortByScore(&ranked);
  return ranked;
}

/// Accepts the first of the best candidates that passes, if one does.
bool Search::extend(SearchState* state, const std::vector<FittedEffect>& ranked) {
  constexpr std::size_t kMostTried = 5;
  for (std::size_t k = 0; k < std::min(ranked.size(), kMostTried); ++k) {
    if (!context_.going_on()) return false;
    if (ranked[k].score < threshold(*ranked[k].effect)) continue;
    if (accept(state, ranked[k], ranked)) return true;
  }
  return false;
}

/// Fits a candidate to convergence and accepts it if the held-out experiments confirm its gain;
/// causes that it makes needless are eliminated. False where it is not among the causes afterwards.
bool Search::accept(SearchState* state, const FittedEffect& candidate,
                    const std::vector<FittedEffect>& ranked) {
  constexpr double kImprobable = 0.05;
  if (isResidualDistribution(*candidate.effect)) return acceptDistribution(state, candidate);
  context_.report_fitted(candidate.effect->label());
  const std::string& name = candidate.effect->name();
  const bool is_component = candidate.effect->has(Trait::new_component);
  if (is_component && !beatsSimulation(*state, candidate)) return false;
  const Fit fit =
      is_component
          ? takeScoringSteps(candidate.fit, state->train, context_.options, 12, 0.01)
          : optimiseWithRestarts(candidate.fit, state->train, context_, !candidate.restarted);
  const Gain gain = gainOf(heldOut(state->fit, state->held), heldOut(fit, state->held),
                           state->gains(state->fit, fit));
  const double score = fit.log_likelihood - state->fit.log_likelihood - candidate.penalty;
  if (!passes(gain, acceptanceRule(*candidate.effect, score))) return false;
  if (refusals_.isDue(candidate, gain, ranked)) {
    refusals_.add(*candidate.effect, gain);
    return false;
  }
  // Held-out data may refuse the effect that leads by far. The one behind it is then no cause.
  const std::vector<FittedEffect> rivals = refusals_.left(ranked);
  const double confidence = confidenceFor(*state, candidate, fit, rivals);
  if (confidence < kImprobable) return false;
  refusals_.remove(*candidate.effect);
  SearchState next = *state;
  FoundCause cause{candidate.effect,
                   score,
                   candidate.penalty,
                   confidence,
                   equivalentOf(candidate, rivals),
                   mayBeOrder(candidate, rivals),
                   gain,
                   {}};
  next.fit = fit;
  next.causes.push_back(std::move(cause));
  next.total += score;
  if (!is_component) eliminate(&next);
  if (isDifferencing(next.fit)) return false;
  const bool kept = next.has(name);
  if (!kept) next.banned.push_back(name);
  *state = std::move(next);
  return kept;
}

/// Removes causes that do not hold any more, measured against the final model.
void Search::removeThoseThatHoldNoMore(const SearchState& base, SearchState* found) {
  const auto worse = [](const FoundCause& cause) {
    return cause.gain && cause.score != 0 && !stillHolds(*cause.effect, *cause.gain);
  };
  for (;;) {
    const auto cause = std::find_if(found->causes.begin(), found->causes.end(), worse);
    if (cause == found->causes.end()) return;
    const Effects& effects = found->fit.model->effects();
    const auto at = std::find(effects.begin(), effects.end(), cause->effect);
    refusals_.add(*cause->effect, *cause->gain);
    if (at != effects.end())
      found->fit = fittedWithout(found->fit, static_cast<std::size_t>(at - effects.begin()),
                                 found->train, context_);
    found->total -= cause->score;
    found->causes.erase(cause);
    remeasureGains(base, context_, found);
  }
}

/// Backward elimination: removes each cause whose removal costs less than was needed to accept it.
/// That includes the newest, which may only have helped theta out of a local optimum.
void Search::eliminate(SearchState* state) {
  for (std::size_t k = 0; k < state->causes.size();) {
    const FoundCause& cause = state->causes[k];
    const auto& effects = state->fit.model->effects();
    const auto at = std::find(effects.begin(), effects.end(), cause.effect);
    if (at == effects.end()) {
      ++k;
      continue;
    }
    const Fit reduced = fittedWithout(state->fit, static_cast<std::size_t>(at - effects.begin()),
                                      state->train, context_);
    const double loss = state->fit.log_likelihood - reduced.log_likelihood;
    if (!(loss < cause.penalty + threshold(*cause.effect))) {
      ++k;
      continue;
    }
    state->total -= loss - cause.penalty;
    state->fit = reduced;
    state->eliminated = true;
    state->causes.erase(state->causes.begin() + static_cast<std::ptrdiff_t>(k));
  }
}

bool Search::beatsSimulation(const SearchState& state, const FittedEffect& candidate) const {
  const double ratio = candidate.fit.log_likelihood - state.fit.log_likelihood;
  return exceedsSimulatedRatios(state.fit, state.train, context_, ratio);
}

/// Greedy forward selection: accepts causes until none passes, or until there are `most`.
void Search::forwardSelection(SearchState* state, std::size_t most) {
  constexpr int kMostRankings = 10;  // data that need more are not described by the catalogue
  // A cause that is accepted and then eliminated counts as well, so that the loop ends.
  int attempts = options_.max_causes + 2;
  while (state->causes.size() < most && attempts-- > 0 && rankings_ < kMostRankings &&
         context_.going_on()) {
    const std::size_t banned = state->banned.size();
    if (!extend(state, rank(*state)) && state->banned.size() == banned) return;
  }
}

/// Replaces the screening score and gain of the first cause by those of its final fit.
void Search::updateTried(const FoundCause& first) {
  for (TriedEffect& tried : tried_) {
    const EffectDescription& of = first.effect->description();
    if (tried.name != of.name || tried.variant != of.variant || !first.gain) continue;
    tried.score = first.score;
    tried.held_out_gain = first.gain->log_density;
    tried.standard_error = first.gain->standard_error;
  }
  std::stable_sort(
      tried_.begin(), tried_.end(),
      [](const TriedEffect& left, const TriedEffect& right) { return left.score > right.score; });
}

/// The state with gains that belong to all of its causes, without those that hold no more.
SearchState Search::measured(const SearchState& base, SearchState found) {
  if (found.eliminated) remeasureGains(base, context_, &found);
  removeThoseThatHoldNoMore(base, &found);
  return found;
}

SearchState Search::run(const SearchState& base) {
  SearchState found = measured(base, search(base));
  if (found.causes.size() > base.causes.size()) updateTried(found.causes[base.causes.size()]);
  return found;
}

SearchState Search::withAnother(SearchState found) {
  const SearchState base = found;
  forwardSelection(&found, base.causes.size() + 1);
  return measured(base, std::move(found));
}

SearchState Search::search(const SearchState& base) {
  constexpr std::size_t kRestarts = 3;
  const auto most = base.causes.size() + static_cast<std::size_t>(options_.max_causes);
  const std::vector<FittedEffect> ranked = rank(base);
  for (const FittedEffect& candidate : ranked) tried_.push_back(triedEffect(base, candidate));
  SearchState best = base;
  if (most == base.causes.size() || !(extend(&best, ranked) || best.banned != base.banned))
    return best;
  forwardSelection(&best, most);
  const bool one_cause_suffices = best.causes.size() <= base.causes.size() + 1 &&
                                  allPassed(checkResiduals(best.fit, best.train, best.law));
  if (one_cause_suffices) return best;
  std::size_t restarts = 0;
  for (auto first = ranked.begin(); first != ranked.end(); ++first) {
    if (restarts == kRestarts || !context_.going_on()) break;
    const bool structural = !isOfNoise(*first->effect) && !isOfMixture(*first->effect);
    if (!structural || first->score < threshold(*first->effect) ||
        (best.causes.size() > base.causes.size() &&
         first->effect == best.causes[base.causes.size()].effect))
      continue;
    ++restarts;
    SearchState other = base;
    // Effects ranked above it do not count: where this set is kept, it has the higher likelihood.
    if (!accept(&other, *first, {first, ranked.end()})) continue;
    forwardSelection(&other, std::min(most, base.causes.size() + 2));
    if (other.total > best.total) best = std::move(other);
  }
  if (best.causes.size() < most) forwardSelection(&best, most);
  return best;
}

}  // namespace uncertainty_identification
