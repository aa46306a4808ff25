#include "model/zero_order_hold.h"

#include <algorithm>
#include <unsupported/Eigen/MatrixFunctions>
#include <utility>

namespace uncertainty_identification {
namespace {

/// Zero-order hold over `time`, in sample times: e^(A time), and the integral of e^(A s) b over [0,
/// time].
std::pair<Eigen::MatrixXd, Eigen::VectorXd> hold(const Eigen::MatrixXd& A, const Eigen::VectorXd& b,
                                                 double time) {
  const Eigen::Index n = A.rows();
  Eigen::MatrixXd augmented = Eigen::MatrixXd::Zero(n + 1, n + 1);
  augmented.topLeftCorner(n, n) = time * A;
  augmented.topRightCorner(n, 1) = time * b;
  const Eigen::MatrixXd exponential = augmented.exp();
  return {exponential.topLeftCorner(n, n), exponential.topRightCorner(n, 1)};
}

}  // namespace

void discretise(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator,
                double dead_samples, int extra, Polynomials* p) {
  const Eigen::Index n = denominator.size() - 1;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);  // controllable form, highest power scaled to 1
  A.diagonal(1).setOnes();
  A.row(n - 1) = -denominator.head(n).transpose() / denominator[n];
  Eigen::VectorXd input = Eigen::VectorXd::Zero(n), output = Eigen::VectorXd::Zero(n);
  input[n - 1] = 1 / denominator[n];
  output.head(numerator.size()) = numerator;

  const int whole = static_cast<int>(dead_samples);
  const double fraction = dead_samples - whole;
  // The previous input acts during the fraction of the dead time, the newest one after it.
  const auto [remaining, newest] = hold(A, input, 1 - fraction);
  Eigen::VectorXd older = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd transition = remaining;
  if (fraction > 0) {
    older = remaining * hold(A, input, fraction).second;
    transition = hold(A, input, 1).first;
  }

  p->a.resize(n);
  p->b = Eigen::VectorXd::Zero(n + extra);
  Eigen::MatrixXd adjugate = Eigen::MatrixXd::Identity(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    p->b[k + std::min(whole, std::max(extra - 1, 0))] += output.dot(adjugate * newest);
    if (extra > 0) p->b[k + std::min(whole, extra - 1) + 1] += output.dot(adjugate * older);
    const Eigen::MatrixXd product = transition * adjugate;
    p->a[k] = -product.trace() / static_cast<double>(k + 1);
    adjugate = product;
    adjugate.diagonal().array() += p->a[k];
  }
}

}  // namespace uncertainty_identification
