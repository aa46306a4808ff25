#include "math/innovations_form.h"

namespace uncertainty_identification {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd padded(const VectorXd& from, Eigen::Index size) {
  VectorXd to = VectorXd::Zero(size);
  to.head(from.size()) = from;
  return to;
}

MatrixXd solveLyapunov(MatrixXd F, MatrixXd Q) {
  for (int step = 0; step < 60; ++step) {
    const MatrixXd increment = F * Q * F.transpose();
    Q += increment;
    if (increment.cwiseAbs().maxCoeff() <= 1e-17 * Q.cwiseAbs().maxCoeff()) break;
    F = (F * F).eval();
  }
  return Q;
}

MatrixXd observerTransition(const VectorXd& d) {
  MatrixXd F = MatrixXd::Zero(d.size(), d.size());
  F.diagonal(1).setOnes();
  F.col(0) = -d;
  return F;
}

MatrixXd InnovationsForm::stationaryCovariance() const {
  return solveLyapunov(F, K * K.transpose());
}

}  // namespace uncertainty_identification
