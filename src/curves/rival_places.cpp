#include "curves/rival_places.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "curves/fit_comparison.h"
#include "curves/held_out.h"
#include "curves/search_from.h"

namespace uncertainty_identification {
namespace {

bool isPlaceOf(const FoundCurve& cause, Place place) {
  return cause.place.place == place ||
         std::any_of(cause.ties.begin(), cause.ties.end(),
                     [&](const TiedCurve& tie) { return tie.place.place == place; });
}

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

/// Whether unseen windows cannot tell that `best` is better, even if the rival has a cause more.
bool isTied(const CurveSearchResult& rival, const CurveSearchResult& best,
            const SimulationData& held) {
  constexpr double kSignificant = 2, kFar = 1.5;
  const Eigen::VectorXd unseen = unseenErrors(rival.fit, held);
  const Eigen::VectorXd of_best = unseenErrors(best.fit, held);
  return !rival.causes.empty() && rival.causes.size() <= best.causes.size() + 1 &&
         unseen.sum() < kFar * of_best.sum() && pairedT(unseen, of_best) < kSignificant;
}

}  // namespace

CurveSearchResult comparedWithRivals(CurveSearchResult best, const SimulationData& data,
                                     const SimulationData& held, const LinearPlants& linear,
                                     const CurveSearchLimits& limits,
                                     const CurveSearchContext& context) {
  const FirstChoice choice = std::move(best.first);
  if (best.causes.empty()) return best;
  CurveSearchLimits within = limits;
  const FoundCurve first = best.causes.front();
  within.candidates.excluded = [&](Place place) {
    return isPlaceOf(first, place) ||
           (limits.candidates.excluded && limits.candidates.excluded(place));
  };
  std::vector<CurveSearchResult> others;
  for (const CurveCandidate& rival : rivalsOf(choice)) {
    if (!context.going_on()) break;
    CurveSearchResult found = searchBehind(rival, choice, data, held, linear, within, context);
    found.base = best.base;
    const bool is_better = found.causes.size() <= best.causes.size() && !found.causes.empty() &&
                           isBetter(found, best, limits.least_share);
    if (is_better) std::swap(found, best);
    others.push_back(std::move(found));
  }
  for (const CurveSearchResult& other : others)
    if (isTied(other, best, held))
      addPlaceTie({other.causes.front().place, other.causes.front().shape}, &best.causes.front());
  return best;
}

}  // namespace uncertainty_identification
