#include "curves/rival_places.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "curves/beyond_differences.h"
#include "curves/fit_comparison.h"
#include "curves/held_out.h"
#include "curves/refuted_places.h"
#include "curves/search_from.h"

namespace uncertainty_identification {
namespace {

/// Places with which unseen windows gain at least half of what they gain with the first cause.
std::vector<CurveCandidate> rivalsOf(const FirstChoice& choice) {
  constexpr std::size_t kMost = 3;
  constexpr double kHalf = 0.5;
  std::vector<CurveCandidate> rivals;
  const double now = choice.unseen.sum(), gain = now - choice.chosen_unseen;
  for (const CurveCandidate& other : choice.others)
    if (rivals.size() < kMost && now - other.unseen.sum() > kHalf * gain) rivals.push_back(other);
  return rivals;
}

/// Errors of unseen windows, with a penalty for each parameter.
Eigen::VectorXd penalisedErrors(const WindowFit& fit, const SimulationData& held) {
  return unseenErrors(fit, held) * penaltyOf(fit);
}

/// Whether unseen windows cannot tell that `best` is better, even if the rival has a cause more, or
/// tell so only of what may differ between experiments.
bool isTied(const CurveSearchResult& rival, const CurveSearchResult& best,
            const SimulationData& data, const SimulationData& held) {
  constexpr double kSignificant = 2, kMuch = 1.5;
  const Eigen::VectorXd unseen = penalisedErrors(rival.fit, held),
                        unseen_of_best = penalisedErrors(best.fit, held);
  const bool is_near =
      unseen.sum() < kMuch * unseen_of_best.sum() && pairedT(unseen, unseen_of_best) < kSignificant;
  if (!showDifferences(data, held)) return is_near;
  const Eigen::VectorXd beyond = unseenBeyondDifferences(data, rival.fit, held),
                        beyond_of_best = unseenBeyondDifferences(data, best.fit, held);
  return beyond.sum() < beyond_of_best.sum() || (is_near && !isRefuted(beyond, beyond_of_best));
}

/// Whether the rival's first place is none of those that the answer has.
bool isElsewhere(const CurveSearchResult& rival, const CurveSearchResult& best) {
  return std::none_of(best.causes.begin(), best.causes.end(), [&](const FoundCurve& cause) {
    return mayBeAt(cause, rival.causes.front().place.place);
  });
}

/// The limits of a search that does without the first place of the answer and its ties.
CurveSearchLimits without(const FoundCurve& first, CurveSearchLimits limits) {
  const auto excluded = limits.candidates.excluded;
  limits.candidates.excluded = [first, excluded](Place place) {
    return mayBeAt(first, place) || (excluded && excluded(place));
  };
  return limits;
}

}  // namespace

CurveSearchResult comparedWithRivals(CurveSearchResult best, const SimulationData& data,
                                     const SimulationData& held, const LinearPlants& linear,
                                     const CurveSearchLimits& limits,
                                     const CurveSearchContext& context) {
  const FirstChoice choice = std::exchange(best.first, {});
  // Covariates are not told apart by their places.
  if (best.causes.empty() || !best.causes.front().place.covariate.empty()) return best;
  std::vector<CurveSearchResult> others;
  for (const CurveCandidate& rival : rivalsOf(choice)) {
    const FoundCurve& first = best.causes.front();
    if (mayBeAt(first, rival.place.place)) continue;  // since another rival is the answer
    CurveSearchResult found =
        searchBehind(rival, choice, best.base, data, held, linear, without(first, limits), context);
    if (found.causes.empty() || found.causes.size() > best.causes.size() + 1) continue;
    if (found.ended_early) break;
    found.base = best.base;
    found.first = {};
    if (found.causes.size() <= best.causes.size() && isBetter(found, best, limits.least_share))
      std::swap(found, best);
    others.push_back(std::move(found));
  }
  for (const CurveSearchResult& other : others)
    if (isElsewhere(other, best) && isTied(other, best, data, held))
      addPlaceTie({other.causes.front().place, other.causes.front().shape}, &best.causes.front());
  return best;
}

}  // namespace uncertainty_identification
