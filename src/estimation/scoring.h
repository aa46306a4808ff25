#pragma once

#include <functional>

#include "estimation/climb.h"

namespace uncertainty_identification {

/// Levenberg-Marquardt damping that is remembered from step to step.
class Damping {
 public:
  /// Tries steps (information + lambda diag)^-1 gradient with growing lambda until `improves(step)`
  /// accepts one.
  bool step(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
            const std::function<bool(const Eigen::VectorXd&)>& improves);

 private:
  double lambda_ = 1e-6;
};

}  // namespace uncertainty_identification
