#include "curves/naming.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "curves/fit_comparison.h"

namespace uncertainty_identification {
namespace {

/// A shape with the parameters that come closest to a free curve.
struct ClosestShape {
  double distance = std::numeric_limits<double>::infinity();
  const Shape* shape = nullptr;
  Eigen::VectorXd parameters;
};

/// How far a shape with these parameters is from the free curve; sets its factor, if it has one, to
/// the best. Shapes of more parameters must be closer.
double distanceFrom(const Eigen::VectorXd& values, const Curve& curve,
                    Eigen::VectorXd* parameters) {
  Eigen::VectorXd own = curve.atSamples(*parameters);
  if (!curve.shape()->is_whole) {
    const double factor = own.dot(values) / (own.squaredNorm() + 1e-12);
    (*parameters)[0] *= factor;
    own *= factor;
  }
  return (values - own).squaredNorm() * (1 + 0.05 * curve.shape()->count());
}

/// How near the shape comes where each parameter is moved up and down by steps that shrink, as long
/// as that helps. Limits and dead zones whose starts all lie beside their true place would
/// otherwise seem far away, and would not be fitted at all.
double leastDistance(const Eigen::VectorXd& values, const Curve& curve, ClosestShape from) {
  constexpr int kRounds = 30;
  constexpr double kSmallest = 0.01;
  double step = 0.25;  // [standard deviations], or of the parameter where that is larger
  for (int k = 0; k < kRounds && step > kSmallest; ++k) {
    bool is_closer = false;
    for (Eigen::Index i = 0; i < from.parameters.size(); ++i) {
      for (const double sign : {-1.0, 1.0}) {
        Eigen::VectorXd moved = from.parameters;
        moved[i] += sign * step * std::max(1.0, std::abs(moved[i]));
        const double distance = distanceFrom(values, curve, &moved);
        if (!(distance < from.distance)) continue;
        from.distance = distance;
        from.parameters = moved;
        is_closer = true;
      }
    }
    if (!is_closer) step /= 2;
  }
  return from.distance;
}

ClosestShape closestTo(const Eigen::VectorXd& values, const Curve& place, const Shape* shape) {
  const Curve curve = place.shaped(shape);
  ClosestShape closest;
  closest.shape = shape;
  for (const std::vector<double>& start : shape->starts) {
    Eigen::VectorXd parameters(shape->count());
    const Eigen::Index first = shape->is_whole ? 0 : 1;
    if (first == 1) parameters[0] = 1;
    for (std::size_t k = 0; k < start.size(); ++k)
      parameters[first + static_cast<Eigen::Index>(k)] = start[k];
    const double distance = distanceFrom(values, curve, &parameters);
    if (distance < closest.distance) {
      closest.distance = distance;
      closest.parameters = parameters;
    }
  }
  if (shape->is_whole) closest.distance = leastDistance(values, curve, closest);
  return closest;
}

std::vector<ClosestShape> closestShapes(const Eigen::VectorXd& values, const Curve& place,
                                        const CurveSearchContext& context) {
  std::vector<ClosestShape> found;
  for (const Shape* shape : shapesAt(place.place())) {
    const bool is_excluded = context.excluded && context.excluded(place.place(), shape->name);
    const bool has_zero = !hasPhysicalZero(place.place()) || place.coversZero();
    if (!is_excluded && (has_zero || !shape->needs_zero))
      found.push_back(closestTo(values, place, shape));
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const ClosestShape& left, const ClosestShape& right) {
                     return left.distance < right.distance;
                   });
  // Of a signal that never changes its sign, the absolute value is a straight line.
  const auto is_same = [](const ClosestShape& left, const ClosestShape& right) {
    return right.distance - left.distance <= 1e-9 * right.distance;
  };
  found.erase(std::unique(found.begin(), found.end(), is_same), found.end());
  return found;
}

struct Contender {
  double criterion = 0;
  std::string shape;
  WindowFit fit;
};

/// Whether what the curve passes is steeper at the recorded value that is nearest to the physical
/// zero than at the one that is farthest from it.
bool levelsOff(const Curve& curve, const Eigen::VectorXd& parameters) {
  constexpr double kStep = 0.01;  // [standard deviations]
  const double low = curve.samples()[0], high = curve.samples()[curve.samples().size() - 1];
  const double zero = -curve.zero();
  const double nearest = std::min(std::max(zero, low), high);
  const double farthest = zero - low > high - zero ? low : high;
  const Eigen::Vector4d at(nearest - kStep, nearest + kStep, farthest - kStep, farthest + kStep);
  const Eigen::VectorXd passed = curve.characteristic(at, parameters);
  return std::abs(passed[3] - passed[2]) < std::abs(passed[1] - passed[0]);
}

/// Whether the last curve is what its shape is called. Friction that pushes along with the motion
/// is none: it stands for something else that limits the speed. Nor is a sine that pushes away from
/// zero the weight of what hangs: with the linear plant it is a spring that hardens. A curve that
/// grows steeper does not level off.
bool isPossible(const CurveModel& model) {
  const Curve& curve = model.curves.back();
  if (curve.shape()->levels_off && isPassed(curve.place()))
    return levelsOff(curve, model.parametersOf(model.curves.size() - 1));
  if (!curve.shape()->opposes || !isFedBack(curve.place())) return true;
  const double gain =
      curve.place() == Place::output_state
          ? 1
          : model.directGain() + model.theta.segment(model.order, model.order).sum();
  return gain * model.parametersOf(model.curves.size() - 1)[0] <= 0;
}

/// The share of the free curve's gain that each contender has; the free curve is the first.
std::vector<double> sharesOf(const std::vector<Contender>& contenders, const WindowFit& before) {
  const double gain = before.squared_error - contenders.front().fit.squared_error;
  std::vector<double> shares(contenders.size());
  std::transform(contenders.begin(), contenders.end(), shares.begin(), [&](const Contender& each) {
    return gain > 0 ? (before.squared_error - each.fit.squared_error) / gain : 0;
  });
  return shares;
}

/// Whether windows that are left out do not tell a shape from the chosen one. The criterion cannot
/// say so where experiments differ: what they differ by is no noise of the samples.
bool isAsGood(const WindowFit& other, const WindowFit& chosen) {
  constexpr double kFar = 1.25, kSignificant = 1.645;  // of the error; 95 %, one-sided
  return other.left_out < kFar * chosen.left_out &&
         pairedT(other.left_out_of, chosen.left_out_of) < kSignificant;
}

/// The first in the order of shapesAt() of the shapes within 2 of the best contender. The free
/// curve is none where a shape has nearly all of its gain: with little noise no shape is exact.
std::size_t chosen(const std::vector<Contender>& contenders, const std::vector<double>& shares,
                   Place place) {
  constexpr double kNearlyAll = 0.99;
  const bool is_shape = *std::max_element(shares.begin() + 1, shares.end()) >= kNearlyAll;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t k = is_shape ? 1 : 0; k < contenders.size(); ++k)
    best = std::min(best, contenders[k].criterion);
  for (const Shape* shape : shapesAt(place))
    for (std::size_t k = 1; k < contenders.size(); ++k)
      if (contenders[k].shape == shape->name && contenders[k].criterion < best + 2) return k;
  return 0;
}

}  // namespace

Naming nameCurve(const SimulationData& data, const WindowFit& before, const WindowFit& free,
                 const WindowFit& linearised, int shapes, const CurveSearchContext& context) {
  const Curve& place = free.model.curves.back();
  if (isScalar(place.place())) return {free, nameOf(place.place()), "", 0, {}};
  const bool gained =
      linearised.step.size() == 0 || free.squared_error < 0.97 * before.squared_error;
  const int own = place.parameters();
  CurveModel from = free.model;
  if (!gained) {
    from.theta.head(before.parameters()) = before.model.theta;
    from.theta.tail(own) = linearised.step.tail(own);
    from.initial = before.model.initial;
  }
  const Eigen::VectorXd values = place.atSamples(from.theta.tail(own));
  const double samples = effectiveSamples(gained ? free : before);
  std::vector<Contender> contenders{{criterion(free, samples), "curve", free}};
  std::vector<ClosestShape> closest = closestShapes(values, place, context);
  if (static_cast<int>(closest.size()) > shapes) closest.resize(static_cast<std::size_t>(shapes));
  for (const ClosestShape& each : closest) {
    CurveModel model = from;
    model.curves.back() = place.shaped(each.shape);
    Eigen::VectorXd theta(from.theta.size() - own + each.parameters.size());
    theta << from.theta.head(from.theta.size() - own), each.parameters;
    model.theta = std::move(theta);
    WindowFit fit = fitFreely(data, std::move(model), context.limits(15));
    if (!isPossible(fit.model)) continue;
    const double reached = criterion(fit, samples);
    contenders.push_back({reached, each.shape->name, std::move(fit)});
  }
  const std::vector<double> shares = sharesOf(contenders, before);
  const std::size_t best = contenders.size() > 1 ? chosen(contenders, shares, place.place()) : 0;
  Naming naming;
  naming.shape = contenders[best].shape;
  if (best == 0 && contenders.size() > 1) {
    const auto nearest = std::max_element(shares.begin() + 1, shares.end());
    naming.nearest_share = *nearest;
    naming.nearest = contenders[static_cast<std::size_t>(nearest - shares.begin())].shape;
  }
  for (std::size_t k = 0; k < contenders.size(); ++k)
    if (k != best)
      naming.others.push_back({contenders[k].shape,
                               contenders[k].criterion - contenders[best].criterion,
                               isAsGood(contenders[k].fit, contenders[best].fit)});
  naming.fit = std::move(contenders[best].fit);
  return naming;
}

}  // namespace uncertainty_identification
