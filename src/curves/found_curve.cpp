#include "curves/found_curve.h"

#include <algorithm>

#include "curves/curve_words.h"
#include "curves/fit_comparison.h"

namespace uncertainty_identification {
namespace {

bool isSame(const TiedCurve& left, const TiedCurve& right) {
  return left.place.place == right.place.place && left.place.covariate == right.place.covariate &&
         left.shape == right.shape;
}

/// A covariate without the lag that it is behind of.
std::string withoutLag(const std::string& covariate) {
  return covariate.substr(0, covariate.find(" behind a lag"));
}

std::vector<PlaceOf> placesOf(const FoundCurve& cause) {
  std::vector<PlaceOf> places{cause.place};
  for (const TiedCurve& tie : cause.ties) places.push_back(tie.place);
  return places;
}

bool areAlike(const FoundCurve& cause, const FoundCurve& other) {
  for (const PlaceOf& one : placesOf(cause))
    for (const PlaceOf& another : placesOf(other))
      if (isSamePlace(one.place, another.place) &&
          withoutLag(one.covariate) == withoutLag(another.covariate))
        return true;
  return false;
}

constexpr std::size_t kMostTies = 4;

}  // namespace

void addTie(const TiedCurve& tie, FoundCurve* cause) {
  if (isSame(tie, {cause->place, cause->shape}) || cause->ties.size() == kMostTies) return;
  for (const TiedCurve& other : cause->ties)
    if (isSame(tie, other)) return;
  cause->ties.push_back(tie);
}

void addTies(const Naming& naming, FoundCurve* cause) {
  for (const OtherShape& other : naming.others)
    if ((other.behind < 2 || other.is_as_good) && other.shape != "curve")
      addTie({cause->place, other.shape}, cause);
}

bool mayBeAt(const FoundCurve& cause, Place place) {
  const std::vector<PlaceOf> places = placesOf(cause);
  return std::any_of(places.begin(), places.end(),
                     [&](const PlaceOf& each) { return isSamePlace(each.place, place); });
}

void addPlaceTie(const TiedCurve& tie, FoundCurve* cause) {
  if (mayBeAt(*cause, tie.place.place)) return;
  cause->ties.insert(cause->ties.begin(), tie);
  if (cause->ties.size() > kMostTies) cause->ties.pop_back();
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

std::vector<std::string> possibleNames(const FoundCurve& cause) {
  if (!cause.place.covariate.empty()) return {};  // names do not tell one covariate from another
  std::vector<std::string> names{causeNamed(cause.place.place, cause.shape)};
  if (!cause.nearest.empty()) names.push_back(causeNamed(cause.place.place, cause.nearest));
  for (const TiedCurve& tie : cause.ties) names.push_back(causeNamed(tie.place.place, tie.shape));
  return names;
}

std::size_t countConfirmed(const std::vector<FoundCurve>& causes,
                           const std::vector<FoundCurve>& others) {
  std::size_t count = 0;
  while (count < causes.size() &&
         std::any_of(others.begin(), others.end(),
                     [&](const FoundCurve& other) { return areAlike(causes[count], other); }))
    ++count;
  return count;
}

}  // namespace uncertainty_identification
