#include "curves/refuted_places.h"

#include <algorithm>
#include <map>
#include <utility>

#include "curves/beyond_differences.h"
#include "curves/fit_comparison.h"

namespace uncertainty_identification {
namespace {

using Key = std::pair<Place, std::string>;

Key keyOf(const CurveCandidate& curve) { return {curve.place.place, curve.place.covariate}; }

/// Adds the errors of each place's named curve, beyond what differs between experiments.
void addErrors(const SimulationData& data, const SimulationData& held,
               std::vector<CurveCandidate>* candidates) {
  std::map<Key, Eigen::VectorXd> errors;
  for (CurveCandidate& each : *candidates) {
    if (each.kind != CandidateKind::curve) continue;
    Eigen::VectorXd& own = errors[keyOf(each)];
    if (own.size() == 0) own = unseenBeyondDifferences(data, each.naming.fit, held);
    each.beyond = own;
  }
}

bool haveTwoPlaces(const std::vector<CurveCandidate>& candidates) {
  const auto is_curve = [](const CurveCandidate& each) {
    return each.kind == CandidateKind::curve;
  };
  const auto first = std::find_if(candidates.begin(), candidates.end(), is_curve);
  return std::any_of(first, candidates.end(), [&](const CurveCandidate& each) {
    return is_curve(each) && keyOf(each) != keyOf(*first);
  });
}

}  // namespace

bool isRefuted(const Eigen::VectorXd& beyond, const Eigen::VectorXd& beyond_of_other) {
  constexpr double kFar = 1.5, kSignificant = 2.5;
  return beyond.size() > 0 && beyond.size() == beyond_of_other.size() &&
         beyond.sum() > kFar * beyond_of_other.sum() &&
         pairedT(beyond, beyond_of_other) >= kSignificant;
}

bool isRefuted(const CurveCandidate& curve, const CurveCandidate& other) {
  return !isSamePlace(curve.place.place, other.place.place) &&
         isRefuted(curve.beyond, other.beyond);
}

void dropImitations(const SimulationData& data, const SimulationData& held,
                    std::vector<CurveCandidate>* candidates) {
  if (!showDifferences(data, held) || !haveTwoPlaces(*candidates)) return;
  addErrors(data, held, candidates);
  const std::vector<CurveCandidate> all = *candidates;
  const auto is_imitation = [&](const CurveCandidate& each) {
    return std::any_of(all.begin(), all.end(), [&](const CurveCandidate& other) {
      return each.named_unseen.sum() < other.named_unseen.sum() && isRefuted(each, other);
    });
  };
  candidates->erase(std::remove_if(candidates->begin(), candidates->end(), is_imitation),
                    candidates->end());
}

}  // namespace uncertainty_identification
