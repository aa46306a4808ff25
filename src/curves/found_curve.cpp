#include "curves/found_curve.h"

#include "curves/fit_comparison.h"

namespace uncertainty_identification {
namespace {

bool isSame(const TiedCurve& left, const TiedCurve& right) {
  return left.place.place == right.place.place && left.place.covariate == right.place.covariate &&
         left.shape == right.shape;
}

}  // namespace

void addTie(const TiedCurve& tie, FoundCurve* cause) {
  constexpr std::size_t kMost = 4;
  if (isSame(tie, {cause->place, cause->shape}) || cause->ties.size() == kMost) return;
  for (const TiedCurve& other : cause->ties)
    if (isSame(tie, other)) return;
  cause->ties.push_back(tie);
}

void addTies(const Naming& naming, FoundCurve* cause) {
  for (const OtherShape& other : naming.others)
    if ((other.behind < 2 || other.is_as_good) && other.shape != "curve")
      addTie({cause->place, other.shape}, cause);
}

FoundCurve foundCurve(const std::vector<CurveCandidate>& tied, const WindowFit& now) {
  const CurveCandidate& first = tied.front();
  FoundCurve found;
  const WindowFit& fit = first.accepted();
  found.place = first.place;
  found.shape = first.naming.shape;
  found.nearest = first.naming.nearest;
  found.nearest_share = first.naming.nearest_share;
  found.left_out_gain = 1 - fit.left_out / now.left_out;
  found.t = pairedT(now.left_out_of, fit.left_out_of);
  for (std::size_t k = 1; k < tied.size(); ++k)
    addTie({tied[k].place, tied[k].naming.shape}, &found);
  addTies(first.naming, &found);
  return found;
}

}  // namespace uncertainty_identification
