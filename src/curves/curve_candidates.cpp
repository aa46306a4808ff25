#include "curves/curve_candidates.h"

#include <algorithm>
#include <complex>
#include <iterator>
#include <string>
#include <utility>

#include "curves/fit_comparison.h"
#include "curves/held_out.h"
#include "curves/refuted_places.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

/// Of places that the data cannot tell apart, the first is named.
int rankOf(const CurveCandidate& candidate) {
  constexpr Place kOrder[] = {Place::input,         Place::position,
                              Place::loop_error,    Place::rate,
                              Place::output_state,  Place::sensor,
                              Place::time_gain,     Place::covariate,
                              Place::position_gain, Place::input_times_position,
                              Place::hysteresis,    Place::rate_gain,
                              Place::time,          Place::covariate_gain,
                              Place::play,          Place::rate_limit,
                              Place::output_play,   Place::input_hysteresis};
  return static_cast<int>(std::find(std::begin(kOrder), std::end(kOrder), candidate.place.place) -
                          std::begin(kOrder));
}

CandidateKind kindOf(PlantChange::Kind kind) {
  return kind == PlantChange::Kind::order    ? CandidateKind::order
         : kind == PlantChange::Kind::direct ? CandidateKind::direct
                                             : CandidateKind::delay;
}

/// The best of the screened places, and those that machines most often have. Hysteresis, which is
/// rare and resembles other products, has to be the best of all. A loop's error, which resembles
/// much, is kept as well and takes the place of no other.
void keepMostPromising(int places, std::vector<ScreenedPlace>* screened) {
  std::vector<ScreenedPlace> kept;
  int others = 0;  // than a loop's error
  for (ScreenedPlace& each : *screened) {
    const Place place = each.place.place;
    const bool is_usual = place == Place::input || place == Place::position ||
                          place == Place::rate || place == Place::loop_error;
    const bool is_too_rare = place == Place::hysteresis && others > 0;
    if (!is_usual && (others >= places || is_too_rare)) continue;
    others += place != Place::loop_error;
    kept.push_back(std::move(each));
  }
  *screened = std::move(kept);
}

/// Whether the loop does not depend on speed, as hysteresis must not: without the curve the plant
/// sums the motion up, by a pole at 1.
bool sumsUp(const CurveModel& model) {
  constexpr double kNear = 0.03;
  const Eigen::VectorXcd poles = roots(model.theta.head(model.order));
  return std::any_of(poles.data(), poles.data() + poles.size(),
                     [](const std::complex<double>& pole) { return std::abs(pole - 1.0) < kNear; });
}

/// Whether the error of a loop acts through a limit: other curves of it resemble friction and other
/// forces. The loop's own plant comes to rest, and the limits lie on both sides of that.
bool isLimitOfLoop(const Naming& naming) {
  if (naming.shape == "curve" || !comesToRest(naming.fit.model)) return false;
  const Eigen::VectorXd limits = naming.fit.model.parametersOf(0);
  return limits.size() == 1 || limits[0] * limits[1] < 0;
}

bool isPossible(const CurveCandidate& candidate) {
  const Place place = candidate.place.place;
  if (candidate.fit.parameters() == 0) return false;
  if (place == Place::loop_error) return isLimitOfLoop(candidate.naming);
  return place != Place::hysteresis ||
         (sumsUp(candidate.fit.model) && sumsUp(candidate.naming.fit.model));
}

void tellPlace(const std::vector<ScreenedPlace>& screened, std::size_t k,
               const CurveSearchContext& context) {
  if (!context.tell) return;
  std::string place = nameOf(screened[k].place.place);
  std::replace(place.begin(), place.end(), '_', ' ');
  context.tell("comparing curves: " + place + ", " + std::to_string(k + 1) + " of " +
               std::to_string(screened.size()));
}

void addCurves(const SimulationData& data, const WindowFit& now, const CandidateLimits& limits,
               const CurveSearchContext& context, std::vector<CurveCandidate>* all) {
  constexpr int kShapes = 5;
  std::vector<ScreenedPlace> screened = screenPlaces(data, now, limits.excluded, context);
  keepMostPromising(limits.places, &screened);
  std::vector<CurveCandidate> found(screened.size() * 2);
  context.pool->forEach(static_cast<int>(screened.size()), [&](int index) {
    const auto k = static_cast<std::size_t>(index);
    if (!context.going_on()) return;
    tellPlace(screened, k, context);
    CurveCandidate& whole = found[2 * k];
    whole.kind = CandidateKind::curve;
    whole.place = screened[k].place;
    whole.fit = fitPlace(data, now, screened[k], context);
    whole.naming = nameCurve(data, now, whole.fit, screened[k].fit, kShapes, context);
    found[2 * k + 1] = whole;  // a free curve has leverage: its shape competes as well
    found[2 * k + 1].fit = whole.naming.fit;
    found[2 * k + 1].is_named = true;
  });
  for (CurveCandidate& candidate : found)
    if (isPossible(candidate)) all->push_back(std::move(candidate));
}

/// Dead time must beat order + 2; a higher order must beat dead time where that gains much.
void dropDominated(const WindowFit& now, std::vector<CurveCandidate>* all) {
  constexpr double kMuch = 0.75, kAsGood = 1.1, kNone = 1e30;
  double order = kNone, delay = kNone;
  for (const CurveCandidate& each : *all) {
    if (each.kind == CandidateKind::order) order = std::min(order, each.fit.left_out);
    if (each.kind == CandidateKind::delay) delay = std::min(delay, each.fit.left_out);
  }
  const auto is_dominated = [&](const CurveCandidate& each) {
    if (each.kind == CandidateKind::delay)
      return each.fit.left_out > kMuch * now.left_out || each.fit.left_out > kAsGood * order;
    return each.kind == CandidateKind::order && delay < kMuch * now.left_out &&
           delay <= kAsGood * order;
  };
  all->erase(std::remove_if(all->begin(), all->end(), is_dominated), all->end());
}

/// A force that varies between samples acts on both states of a discrete plant, so that a curve of
/// the output's own state may lead that of the position. It is the position that is meant.
bool isSameForce(const CurveCandidate& position, const CurveCandidate& best,
                 const Eigen::VectorXd& now) {
  constexpr double kShare = 0.95;  // of the gain
  return best.place.place == Place::output_state && position.place.place == Place::position &&
         (now - position.unseen).sum() > kShare * (now - best.unseen).sum();
}

/// The unseen errors, with a penalty for each parameter.
double penalised(const CurveCandidate& candidate) {
  return candidate.named_unseen.sum() * penaltyOf(candidate.naming.fit);
}

/// Four weights of plays also fit what is not a hysteresis, such as a dead zone in a closed loop.
bool mustBeFarBetter(const CurveCandidate& candidate) {
  return candidate.place.place == Place::input_hysteresis;
}

bool hasSmallerError(const CurveCandidate& left, const CurveCandidate& right) {
  return left.unseen.sum() < right.unseen.sum();
}

/// Fills in the unseen errors, which `unseen` gives of a fit: of each fit once, since the named
/// curve competes itself.
void fillUnseen(const std::function<Eigen::VectorXd(const WindowFit&)>& unseen, WorkerPool* pool,
                std::vector<CurveCandidate>* all) {
  const auto namedOf = [all](const CurveCandidate& free) {
    return std::find_if(all->begin(), all->end(), [&](const CurveCandidate& each) {
      return each.is_named && each.place.place == free.place.place &&
             each.place.covariate == free.place.covariate;
    });
  };
  const auto is_curve = [](const CurveCandidate& each) {
    return each.kind == CandidateKind::curve;
  };
  pool->forEach(static_cast<int>(all->size()), [&](int index) {
    CurveCandidate& each = (*all)[static_cast<std::size_t>(index)];
    each.unseen = unseen(each.fit);
    if (is_curve(each) && namedOf(each) == all->end()) each.named_unseen = unseen(each.naming.fit);
  });
  for (CurveCandidate& each : *all)
    if (const auto named = namedOf(each); is_curve(each) && named != all->end())
      each.named_unseen = named->unseen;
}

}  // namespace

std::vector<CurveCandidate> candidatesFor(const SimulationData& data, const SimulationData& held,
                                          const WindowFit& now, const LinearPlants& linear,
                                          const CandidateLimits& limits,
                                          const CurveSearchContext& context) {
  std::vector<CurveCandidate> all;
  const int most = now.model.curves.empty() ? limits.max_order : std::min(limits.max_order, 3);
  for (PlantChange& change : largerPlants(data, now, linear, most, context))
    all.push_back({kindOf(change.kind), {}, std::move(change.fit), {}, {}, {}, {}, false});
  addCurves(data, now, limits, context, &all);
  dropDominated(now, &all);
  fillUnseen([&](const WindowFit& fit) { return unseenErrors(fit, held); }, context.pool, &all);
  std::stable_sort(all.begin(), all.end(), hasSmallerError);
  return all;
}

std::vector<CurveCandidate> curvesBeyondDifferences(
    std::vector<CurveCandidate> all, const Eigen::VectorXd& now, WorkerPool* pool,
    const std::function<Eigen::VectorXd(const WindowFit&)>& unseen) {
  std::vector<CurveCandidate> curves;
  for (CurveCandidate& each : all)
    if (each.kind == CandidateKind::curve && each.unseen.sum() < now.sum())
      curves.push_back(std::move(each));
  fillUnseen(unseen, pool, &curves);
  const auto shows_none = [](const CurveCandidate& each) { return each.unseen.size() == 0; };
  curves.erase(std::remove_if(curves.begin(), curves.end(), shows_none), curves.end());
  std::stable_sort(curves.begin(), curves.end(), hasSmallerError);
  return curves;
}

std::vector<CurveCandidate> ofOtherPlaces(const std::vector<CurveCandidate>& all,
                                          const std::vector<CurveCandidate>& tied) {
  std::vector<CurveCandidate> others;
  const auto isAt = [](const std::vector<CurveCandidate>& curves, Place place) {
    return std::any_of(curves.begin(), curves.end(),
                       [&](const CurveCandidate& each) { return each.place.place == place; });
  };
  for (const CurveCandidate& each : all)
    if (each.kind == CandidateKind::curve && !isAt(tied, each.place.place) &&
        !isAt(others, each.place.place))
      others.push_back(each);
  return others;
}

std::vector<CurveCandidate> tiedWithFirst(const std::vector<CurveCandidate>& all,
                                          const Eigen::VectorXd& now) {
  constexpr std::size_t kMost = 8;
  constexpr double kSignificant = 2, kNear = 1.05, kFar = 1.25, kRival = 1.1;
  const Eigen::VectorXd& best = all.front().unseen;
  const double near = mustBeFarBetter(all.front()) ? kFar : kRival;
  std::vector<CurveCandidate> found;
  for (const CurveCandidate& each : all) {
    const bool is_rival = pairedT(each.unseen, best) < kSignificant ||
                          each.unseen.sum() < near * best.sum() ||
                          isSameForce(each, all.front(), now);
    if (each.kind == CandidateKind::curve && is_rival && found.size() < kMost)
      found.push_back(each);
  }
  const CurveCandidate first = *std::min_element(
      found.begin(), found.end(), [](const CurveCandidate& left, const CurveCandidate& right) {
        return penalised(left) < penalised(right);
      });
  const double least = penalised(first);
  const auto is_apart = [&](const CurveCandidate& each) {
    if (isRefuted(each, first)) return true;
    return penalised(each) >= kNear * least && !isSameForce(each, first, now) &&
           (penalised(each) >= kFar * least ||
            (!mustBeFarBetter(first) &&
             pairedT(each.named_unseen, first.named_unseen) >= kSignificant));
  };
  found.erase(std::remove_if(found.begin(), found.end(), is_apart), found.end());
  std::stable_sort(found.begin(), found.end(),
                   [](const CurveCandidate& left, const CurveCandidate& right) {
                     return std::make_pair(rankOf(left), penalised(left)) <
                            std::make_pair(rankOf(right), penalised(right));
                   });
  return found;
}

}  // namespace uncertainty_identification
