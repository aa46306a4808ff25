// The N x N covariance of ARMA noise with a stationary start and missing samples against the two
// other exact accounts in docs/method.md: a Kalman filter in innovations form, and start and gap
// columns.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/dense_likelihood.h"
#include "support/random_system.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// s' = F s + K w, v = s_0 + w.
struct InnovationsForm {
  MatrixXd F;
  VectorXd K;
  MatrixXd start;  ///< stationary covariance of s
};

VectorXd padded(const VectorXd& values, Eigen::Index size) {
  VectorXd result = VectorXd::Zero(size);
  result.head(values.size()) = values;
  return result;
}

InnovationsForm innovationsForm(const VectorXd& c, const VectorXd& d) {
  const Eigen::Index order = std::max(c.size(), d.size());
  InnovationsForm form;
  form.F = MatrixXd::Zero(order, order);
  form.F.col(0) = -padded(d, order);
  form.F.diagonal(1).setOnes();
  form.K = padded(c, order) - padded(d, order);
  form.start = MatrixXd::Zero(order, order);
  MatrixXd term = form.K * form.K.transpose();
  for (int k = 0; k < 5000; ++k) {
    form.start += term;
    term = form.F * term * form.F.transpose();
  }
  return form;
}

double kalmanLogLikelihood(const InnovationsForm& form, const Experiment& experiment) {
  const MatrixXd drive = form.K * form.K.transpose();
  MatrixXd P = form.start;
  VectorXd s = VectorXd::Zero(form.K.size());
  double result = 0;
  for (int t = 0; t < experiment.samples(); ++t) {
    if (experiment.isValid(t)) {
      const double S = P(0, 0) + 1;
      const VectorXd gain = (form.F * P.col(0) + form.K) / S;
      const double nu = experiment.y[t] - s[0];
      result -= 0.5 * (std::log(2 * std::acos(-1.0) * S) + nu * nu / S);
      s = form.F * s + gain * nu;
      P = form.F * P * form.F.transpose() + drive - S * gain * gain.transpose();
    } else {
      s = form.F * s;
      P = form.F * P * form.F.transpose() + drive;
    }
  }
  return result;
}

/// Observed innovations of the masked filter that enters sample `first` in state s.
VectorXd maskedFilter(const InnovationsForm& form, const Experiment& experiment, const VectorXd& y,
                      VectorXd s, int first) {
  std::vector<double> innovations;
  for (int t = 0; t < experiment.samples(); ++t) {
    const double nu = t < first ? 0 : y[t] - s[0];
    if (experiment.isValid(t)) innovations.push_back(nu);
    if (t < first) continue;
    s = form.F * s;
    if (experiment.isValid(t)) s += form.K * nu;
  }
  return Eigen::Map<VectorXd>(innovations.data(), static_cast<Eigen::Index>(innovations.size()));
}

MatrixXd startAndGapColumns(const InnovationsForm& form, const Experiment& experiment) {
  const VectorXd silence = VectorXd::Zero(experiment.samples());
  MatrixXd columns(experiment.validSamples(), 0);
  const auto append = [&](const MatrixXd& covariance, int first) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(covariance);
    for (Eigen::Index k = 0; k < covariance.rows(); ++k) {
      const double deviation = std::sqrt(std::max(eigen.eigenvalues()[k], 0.0));
      columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
      columns.rightCols(1) =
          maskedFilter(form, experiment, silence, -deviation * eigen.eigenvectors().col(k), first);
    }
  };
  append(form.start, 0);
  MatrixXd gap = MatrixXd::Zero(form.K.size(), form.K.size());
  for (int t = 0; t < experiment.samples(); ++t) {
    if (!experiment.isValid(t)) {
      gap = form.F * gap * form.F.transpose() + form.K * form.K.transpose();
    } else if (!gap.isZero(0)) {
      append(gap, t);
      gap.setZero();
    }
  }
  return columns;
}

TEST(DenseNoise, AgreesWithKalmanFilterAndColumns) {
  const std::vector<std::pair<int, int>> orders = {{1, 1}, {2, 3}, {3, 2}, {0, 2}, {2, 0}};
  for (const auto& [nc, nd] : orders) {
    test::RandomSystemOptions options;
    options.nc = nc;
    options.nd = nd;
    options.taps = 0;
    options.missing = 0.25;
    options.noise_variance = 1;
    options.experiments = 3;
    options.noise_run_up = 500;
    auto system = test::randomSystem(options, 40 + static_cast<std::uint64_t>(nc));
    system.truth.b.setZero();
    const InnovationsForm form = innovationsForm(system.truth.c, system.truth.d);
    dense::Options stationary;
    stationary.noise_start = NoiseStart::stationary;
    for (const auto& experiment : system.experiments) {
      const double expected = dense::logLikelihood({experiment}, system.truth, stationary);
      EXPECT_NEAR(kalmanLogLikelihood(form, experiment), expected, 1e-9 * std::abs(expected));

      const VectorXd e =
          maskedFilter(form, experiment, experiment.y, VectorXd::Zero(form.K.size()), 0);
      const MatrixXd Z = startAndGapColumns(form, experiment);
      const MatrixXd V = MatrixXd::Identity(e.size(), e.size()) + Z * Z.transpose();
      const double by_columns =
          -0.5 * (double(e.size()) * std::log(2 * std::acos(-1.0)) + std::log(V.determinant()) +
                  e.dot(V.partialPivLu().solve(e)));
      EXPECT_NEAR(by_columns, expected, 1e-9 * std::abs(expected)) << nc << " " << nd;
    }
  }
}

}  // namespace
}  // namespace uncertainty_identification
