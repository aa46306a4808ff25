#include "curves/split_model.h"

namespace uncertainty_identification {

SplitModel splitOff(const CurveModel& model) {
  const Curve curve = model.curves.front();
  const int first = model.linearParameters(), count = curve.parameters();
  SplitModel parts{model, curve, model.theta.segment(first, count)};
  const Eigen::VectorXd behind = model.theta.tail(model.theta.size() - first - count);
  parts.without.curves.erase(parts.without.curves.begin());
  parts.without.theta.conservativeResize(first + behind.size());
  parts.without.theta.tail(behind.size()) = behind;
  return parts;
}

}  // namespace uncertainty_identification
