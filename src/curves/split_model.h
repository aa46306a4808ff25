#pragma once

#include "curves/curve_model.h"

namespace uncertainty_identification {

/// A model without its first curve, that curve, and its parameters.
struct SplitModel {
  CurveModel without;
  Curve curve;
  Eigen::VectorXd own;

  /// The model with `curve` behind the others.
  CurveModel with(const CurveModel& base, const Curve& added, const Eigen::VectorXd& values) const {
    CurveModel model = base;
    model.curves.push_back(added);
    model.theta.conservativeResize(base.theta.size() + values.size());
    model.theta.tail(values.size()) = values;
    return model;
  }
};

SplitModel splitOff(const CurveModel& model);

}  // namespace uncertainty_identification
