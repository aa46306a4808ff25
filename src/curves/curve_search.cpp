#include "curves/curve_search.h"

#include <cmath>
#include <utility>
#include <vector>

#include "curves/fit_comparison.h"
#include "curves/held_out.h"
#include "curves/prediction_check.h"
#include "curves/rival_places.h"
#include "curves/search_from.h"

/// From which linear plants curves are looked for, and which of the searches is believed.
namespace uncertainty_identification {
namespace {

/// Whether causes on top of a plant of first order explain unseen windows far better than high
/// orders do, or better with no more parameters than linear ones.
bool standsForOrders(const CurveSearchResult& with_causes, const CurveSearchResult& orders) {
  constexpr double kFarLess = 0.7, kLess = 0.9;
  const bool is_no_larger =
      orders.causes.empty() && with_causes.fit.parameters() <= orders.fit.parameters();
  return with_causes.held_error <= orders.held_error &&
         with_causes.fit.left_out + with_causes.held_error <
             (is_no_larger ? kLess : kFarLess) * (orders.fit.left_out + orders.held_error);
}

/// Whether a controller holds an unstable plant: a small error grows tenfold within a window. A
/// curve that bends the simulation back then gains, whatever the plant is. A stable plant that
/// sticks oscillates about the controller's setpoint, which looks the same, and is not meant.
bool bendsUnstablePlantBack(const FoundCurve& first, const SimulationData& data) {
  constexpr double kTenfold = 10;
  const Place place = first.place.place;
  const bool may_stick = place == Place::play || place == Place::output_play || sticks(first.shape);
  return !may_stick && std::pow(predictedGrowth(data), data.longest) > kTenfold;
}

/// Whether the causes, which leave much unexplained, simulate better and do not predict better. In
/// a closed loop the input holds the controller's answers to disturbances, from which the
/// simulation drifts away: a dead zone that takes them out, or a friction that holds the simulation
/// back, gains.
bool isControllersAnswer(const SimulationData& data, const SimulationData& held,
                         const CurveSearchLimits& limits, const CurveSearchResult& found) {
  if (heldOutFit(held, Eigen::VectorXd::Constant(1, found.held_error)) > limits.clear_fit)
    return false;
  const auto gain = predictionGain(data, held, found.base.model, found.fit.model);
  return gain &&
         !(gain->share >= limits.least_prediction_gain && gain->t >= limits.least_prediction_t);
}

/// The causes of another search, fitted to these windows.
CurveSearchResult refitted(const CurveSearchResult& other, const SimulationData& data,
                           const SimulationData& held, const CurveSearchContext& context) {
  CurveSearchResult found = other;
  found.first = {};
  found.fit.model.initial.clear();
  found.fit = fitFreely(data, found.fit.model, context.limits(15));
  found.held_error = heldOutErrors(held, found.fit.model).sum();
  found.ended_early = !context.going_on();
  return found;
}

/// Whether causes that were found in other windows explain unseen windows so much better than what
/// these show by themselves, and significantly.
bool isConfirmed(const CurveSearchResult& found, const CurveSearchResult& best,
                 const SimulationData& held, const CurveSearchLimits& limits) {
  return standsForOrders(found, best) && isSignificant(found.fit) &&
         pairedT(unseenErrors(best.fit, held), unseenErrors(found.fit, held)) >=
             limits.least_held_t;
}

}  // namespace

bool isBetter(const CurveSearchResult& other, const CurveSearchResult& than, double least_share) {
  const double ratio = other.fit.left_out / than.fit.left_out;
  if (other.held_error > 1.05 * than.held_error) return false;
  if (other.causes.size() < than.causes.size()) return ratio < 1.1;
  if (other.causes.size() == than.causes.size()) return ratio < 0.9;
  return ratio < 0.7 && than.fit.left_out - other.fit.left_out > least_share * than.base.left_out;
}

namespace {

/// The best of the searches from several linear plants.
CurveSearchResult bestOfSearches(const SimulationData& data, const SimulationData& held,
                                 const CurveSearchLimits& limits,
                                 const CurveSearchContext& context) {
  if (context.tell) context.tell("fitting the smallest plant");
  const LinearPlants linear = fitLinearPlants(data, limits.candidates.max_order, context);
  // Before the searches, which may take all the time: without it, a mode may pass for a curve.
  const std::optional<WindowFit> modal = modalPlant(data, held, linear, context);
  const auto from = [&](const WindowFit& base) {
    return searchFrom(base, data, held, linear, limits, context);
  };
  CurveSearchResult best;
  const auto take = [&best](CurveSearchResult found) {
    found.base = std::move(best.base);
    best = std::move(found);
  };
  for (const WindowFit& base : linear.starts) {
    CurveSearchResult found = from(base);
    if (best.base.parameters() == 0) {
      best = std::move(found);
      if (best.causes.empty()) break;  // one order more only tells which of several places it is
    } else if (isBetter(found, best, limits.least_share)) {
      take(std::move(found));
    }
  }
  if (modal) {
    CurveSearchResult found;
    found.base = found.fit = *modal;
    found.held_error = heldOutErrors(held, modal->model).sum();
    if (isBetter(found, best, limits.least_share)) best = std::move(found);
  }
  // High orders may only stand for a cause, or for another one.
  const auto fitOfBest = [&] {
    return heldOutFit(held, Eigen::VectorXd::Constant(1, best.held_error));
  };
  if (best.base.model.order > 1 && fitOfBest() < limits.good_fit && context.going_on()) {
    CurveSearchResult found = from(linear.of_order.front());
    const bool is_believed = best.causes.empty() || isBetter(found, best, limits.least_share);
    if (!found.causes.empty() && standsForOrders(found, best) && is_believed)
      take(std::move(found));
  }
  if (limits.suggested && context.going_on()) {
    CurveSearchResult found = refitted(*limits.suggested, data, held, context);
    if (isConfirmed(found, best, held, limits)) {
      take(std::move(found));
      return best;
    }
  }
  if (!limits.compares_places) return best;
  return comparedWithRivals(std::move(best), data, held, linear, limits, context);
}

/// Drops causes that do not simulate held-out windows better than the linear plant, or of which a
/// controller may be the reason: they are none of its errors.
CurveSearchResult believed(CurveSearchResult best, const SimulationData& data,
                           const SimulationData& held, const CurveSearchLimits& limits) {
  const double base_error = heldOutErrors(held, best.base.model).sum();
  const bool is_poor =
      heldOutFit(held, Eigen::VectorXd::Constant(1, best.held_error)) < limits.least_fit;
  const bool is_better = !is_poor && best.held_error < (1 - limits.least_gain) * base_error;
  if (best.causes.empty()) return best;
  best.is_unstable = is_better && bendsUnstablePlantBack(best.causes.front(), data);
  if (is_better && !best.is_unstable && !isControllersAnswer(data, held, limits, best)) return best;
  best.refused = is_better ? std::move(best.causes) : std::vector<FoundCurve>();
  best.causes.clear();
  best.fit = best.base;
  best.held_error = base_error;
  return best;
}

}  // namespace

CurveSearchResult searchCurves(const SimulationData& data, const SimulationData& held,
                               const CurveSearchLimits& limits, const CurveSearchContext& context) {
  return believed(bestOfSearches(data, held, limits, context), data, held, limits);
}

}  // namespace uncertainty_identification
