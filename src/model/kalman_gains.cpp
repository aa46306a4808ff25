#include "model/kalman_gains.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/innovations_form.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Derivative of the Riccati recursion of InnovationsForm in the direction (dF, dK).
template <int Order>
struct RiccatiDerivative {
  using Vector = typename InnovationsFormOf<Order>::Vector;
  using Matrix = typename InnovationsFormOf<Order>::Matrix;

  Vector dd, dK;  ///< derivatives of d (F = [-d | shift]) and K
  Matrix dP;
  double dS = 0;
  Vector dgain;

  /// Must be called before `base.step()`, while `base` still holds P of this step. Computes the
  /// derivatives of S and gain.
  void step(const InnovationsFormOf<Order>& base, bool measured) {
    const Matrix& P = base.P;
    const double S = P(0, 0) + 1;
    const Vector gain = (base.F * P.col(0) + base.K) / S;
    dS = dP(0, 0);
    dgain = (base.F * dP.col(0) - dd * P(0, 0) + dK - gain * dS) / S;
    const Matrix moved = -dd * (P.row(0) * base.F.transpose());  // dF P F'
    Matrix next = base.F * dP * base.F.transpose() + moved + moved.transpose() +
                  dK * base.K.transpose() + base.K * dK.transpose();
    if (measured) {
      next -=
          S * (dgain * gain.transpose() + gain * dgain.transpose()) + dS * gain * gain.transpose();
    }
    dP = next;
  }
};

/// In the direction of coefficient j of c1.., d1.., from the stationary state if `stationary`.
template <int Order>
RiccatiDerivative<Order> derivativeAlong(int j, int nc, const InnovationsForm& form,
                                         const MatrixXd& P0, bool stationary) {
  const Index order = form.K.size();
  const VectorXd unit = VectorXd::Unit(order, j < nc ? j : j - nc), none = VectorXd::Zero(order);
  const VectorXd dd = j < nc ? none : unit, dK = j < nc ? unit : VectorXd(-unit);
  MatrixXd dP = MatrixXd::Zero(order, order);
  if (stationary) {
    const MatrixXd moved = -dd * (P0.row(0) * form.F.transpose());
    dP = solveLyapunov(
        form.F, moved + moved.transpose() + dK * form.K.transpose() + form.K * dK.transpose());
  }
  return {dd, dK, dP, 0, VectorXd(none)};
}

template <int Order>
MatrixXd gainsOf(const NoisePolynomials& noise, const Block& block, int lane, int first,
                 bool until_forgotten) {
  constexpr double kForgotten = 1e-17;
  const Index order = noise.c.size(), parameters = noise.nc + noise.nd;
  const InnovationsForm form(noise.c, noise.d);
  const bool stationary = noise.start == NoiseStart::stationary;
  const MatrixXd P0 = stationary ? form.stationaryCovariance() : form.P;
  InnovationsFormOf<Order> base(noise.c, noise.d);
  base.P = P0;
  std::vector<RiccatiDerivative<Order>> tangents;
  tangents.reserve(static_cast<std::size_t>(parameters));
  for (int j = 0; j < parameters; ++j)
    tangents.push_back(derivativeAlong<Order>(j, noise.nc, form, P0, stationary));
  const Index rows = (order + 1) * (parameters + 1);
  std::vector<double> columns(static_cast<std::size_t>(rows * first), 0.0);
  const int end = block.lengths[static_cast<std::size_t>(lane)];
  for (int t = first; t < end; ++t) {
    const bool measured = block.weight(lane, t) != 0;
    for (RiccatiDerivative<Order>& tangent : tangents) tangent.step(base, measured);
    base.step(measured);
    const double scale = 1 / std::sqrt(base.S);
    double left = base.P.cwiseAbs().maxCoeff();
    for (Index i = 0; i < order; ++i) columns.push_back(base.gain[i] + noise.d[i]);
    columns.push_back(scale);
    for (const RiccatiDerivative<Order>& tangent : tangents) {
      for (Index i = 0; i < order; ++i) columns.push_back(tangent.dgain[i] + tangent.dd[i]);
      columns.push_back(-0.5 * tangent.dS / base.S * scale);
      left = std::max(left, tangent.dP.cwiseAbs().maxCoeff());
    }
    if (until_forgotten && left < kForgotten) break;
  }
  return Eigen::Map<const MatrixXd>(columns.data(), rows,
                                    static_cast<Index>(columns.size()) / rows);
}

}  // namespace

MatrixXd kalmanGains(const NoisePolynomials& noise, const Block& block, int lane, int first,
                     bool until_forgotten) {
  switch (noise.c.size()) {
    case 1:
      return gainsOf<1>(noise, block, lane, first, until_forgotten);
    case 2:
      return gainsOf<2>(noise, block, lane, first, until_forgotten);
    case 3:
      return gainsOf<3>(noise, block, lane, first, until_forgotten);
    default:
      return gainsOf<Eigen::Dynamic>(noise, block, lane, first, until_forgotten);
  }
}

}  // namespace uncertainty_identification
