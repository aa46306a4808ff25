#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/math/mixture.h"

/// Algorithm 1 of the paper as it is printed, (23)-(35), with N x N matrices: what the package's
/// own estimators are timed against. Departures are the errata of docs/method.md: mu^(m+1) in (28),
/// tr(Psi Sigma Psi') in (33) and (35). The nominal model is Box-Jenkins with an FIR error model,
/// at rest before the first sample; every output is measured.
namespace uncertainty_identification::literal {

/// Numbers of coefficients and delay [samples] of Go = q^-delay B/A and H = C/D.
struct Orders {
  int nb = 1, na = 1, nc = 1, nd = 1, delay = 1;
};

/// beta of (14): theta = b, a, c, d concatenated; the mixture of xi, eta = T xi; sigma^2.
struct Parameters {
  Eigen::VectorXd theta;
  Mixture mixture;
  double noise_variance = 1;
};

/// Where one iteration began.
struct TracePoint {
  double log_likelihood = 0;  ///< (16)
  double seconds = 0;         ///< [s] since the start
};

struct Result {
  Parameters parameters;
  double log_likelihood = 0;  ///< (16) at `parameters`
  int iterations = 0;
  double seconds = 0;             ///< [s] wall time
  std::vector<TracePoint> trace;  ///< one for each iteration
};

/// One run of Algorithm 1 on a set of experiments.
class LiteralAlgorithm {
 public:
  /// T is taps x n.
  LiteralAlgorithm(const std::vector<Experiment>& experiments, const Orders& orders,
                   const Eigen::MatrixXd& T)
      : orders_(orders), n_(T.cols()) {
    Eigen::Index longest = 0;
    for (const auto& experiment : experiments) {
      lengths_.push_back(experiment.y.size());
      longest = std::max(longest, experiment.y.size());
    }
    const auto count = static_cast<Eigen::Index>(experiments.size());
    inputs_ = outputs_ = Matrix::Zero(longest, count);
    filtered_inputs_ = Matrix::Zero(longest, count * n_);
    for (Eigen::Index r = 0; r < count; ++r) {
      const auto& experiment = experiments[static_cast<std::size_t>(r)];
      inputs_.col(r).head(experiment.u.size()) = experiment.u;
      outputs_.col(r).head(experiment.y.size()) = experiment.y;
      Matrix taps = Matrix::Zero(longest, T.rows());
      for (Eigen::Index k = 0; k < T.rows(); ++k) {
        taps.col(k).tail(longest - k) = inputs_.col(r).head(longest - k);
      }
      filtered_inputs_.middleCols(r * n_, n_) = taps * T;
    }
  }

  /// Iterates until the parameters change by less than `tolerance` relative to their norm (paper,
  /// section 5).
  Result run(const Parameters& start, int max_iterations = 2000, double tolerance = 1e-6) const {
    const auto begin = std::chrono::steady_clock::now();
    const auto elapsed = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    Result result;
    result.parameters = start;
    double change = 1;
    while (result.iterations < max_iterations && change >= tolerance) {
      const Vector before = stacked(result.parameters);
      result.trace.push_back({iterate(result.parameters), elapsed()});
      const Vector after = stacked(result.parameters);
      change = (after - before).norm() / after.norm();
      ++result.iterations;
    }
    result.seconds = elapsed();
    result.log_likelihood = expectation(result.parameters).log_likelihood;
    return result;
  }

 private:
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;

  /// H^-1 (Y - Go U) and H^-1 Go F(U) T, experiments side by side.
  struct Signals {
    Matrix residuals, regressors;
  };

  /// E-step: zeta_ir (M x kappa), and mean and covariance of xi at [r kappa + i].
  struct Posterior {
    double log_likelihood = 0;
    Matrix responsibilities;
    std::vector<Vector> means;
    std::vector<Matrix> covariances;
  };

  static Vector stacked(const Parameters& parameters) {
    std::vector<double> values;
    const auto append = [&](const auto& block) {
      values.insert(values.end(), block.data(), block.data() + block.size());
    };
    const auto& mixture = parameters.mixture;
    append(parameters.theta);
    append(mixture.weights);
    for (const auto& mean : mixture.means) append(mean);
    for (const auto& covariance : mixture.covariances) append(covariance);
    values.push_back(parameters.noise_variance);
    return Eigen::Map<Vector>(values.data(), static_cast<Eigen::Index>(values.size()));
  }

  /// N x N matrix of q^-delay numerator/denominator at rest; full coefficients, monic denominator.
  Matrix toeplitz(const Vector& numerator, const Vector& denominator, Eigen::Index delay) const {
    const Eigen::Index samples = outputs_.rows();
    Vector h = Vector::Zero(samples);
    for (Eigen::Index t = delay; t < samples; ++t) {
      if (t - delay < numerator.size()) h[t] = numerator[t - delay];
      for (Eigen::Index k = 1; k < denominator.size() && k <= t; ++k)
        h[t] -= denominator[k] * h[t - k];
    }
    Matrix matrix = Matrix::Zero(samples, samples);
    for (Eigen::Index j = 0; j < samples; ++j)
      matrix.col(j).tail(samples - j) = h.head(samples - j);
    return matrix;
  }

  Signals computeSignals(const Vector& theta) const {
    const auto monic = [&](Eigen::Index first, Eigen::Index count) {
      Vector polynomial(count + 1);
      polynomial << 1.0, theta.segment(first, count);
      return polynomial;
    };
    const Orders& o = orders_;
    const Vector a = monic(o.nb, o.na), c = monic(o.nb + o.na, o.nc);
    const Vector d = monic(o.nb + o.na + o.nc, o.nd);
    const Matrix go = toeplitz(theta.head(o.nb), a, o.delay);
    const Matrix inverse_noise_model = toeplitz(d, c, 0);
    const Matrix unexplained = outputs_ - go * inputs_;
    const Matrix filtered = go * filtered_inputs_;
    const auto lower = inverse_noise_model.triangularView<Eigen::Lower>();
    return {lower * unexplained, lower * filtered};
  }

  auto residual(const Signals& signals, Eigen::Index r) const {
    return signals.residuals.col(r).head(lengths_[static_cast<std::size_t>(r)]);
  }

  auto regressors(const Signals& signals, Eigen::Index r) const {
    return signals.regressors.middleCols(r * n_, n_).topRows(lengths_[static_cast<std::size_t>(r)]);
  }

  /// (23)-(25) and (30)-(32).
  Posterior expectation(const Parameters& parameters) const {
    const Signals signals = computeSignals(parameters.theta);
    const auto& mixture = parameters.mixture;
    const auto kappa = static_cast<std::size_t>(mixture.components());
    const Eigen::Index experiments = outputs_.cols();
    Posterior posterior;
    posterior.responsibilities.resize(experiments, mixture.components());
    for (Eigen::Index r = 0; r < experiments; ++r) {
      const Vector e = residual(signals, r);
      const Matrix psi = regressors(signals, r);
      for (std::size_t i = 0; i < kappa; ++i) {
        const Vector& mu = mixture.means[i];
        const Matrix& gamma = mixture.covariances[i];
        Matrix sigma = psi * gamma * psi.transpose();  // (25)
        sigma.diagonal().array() += parameters.noise_variance;
        const Eigen::LLT<Matrix> cholesky(sigma);
        const Vector deviation = e - psi * mu;                        // Y less (24)
        const Matrix gain = cholesky.solve(psi * gamma).transpose();  // (30)
        posterior.means.push_back(mu + gain * deviation);             // (31)
        posterior.covariances.push_back(gamma - gain * psi * gamma);  // (32)
        const double log_determinant = 2 * cholesky.matrixLLT().diagonal().array().log().sum();
        const double quadratic = cholesky.matrixL().solve(deviation).squaredNorm();
        posterior.responsibilities(r, static_cast<Eigen::Index>(i)) =
            std::log(mixture.weights[i]) -
            0.5 * (static_cast<double>(e.size()) * std::log(2 * std::acos(-1.0)) + log_determinant +
                   quadratic);
      }
      auto row = posterior.responsibilities.row(r);
      const double largest = row.maxCoeff();
      const double log_sum = largest + std::log((row.array() - largest).exp().sum());
      posterior.log_likelihood += log_sum;  // (16)
      row = (row.array() - log_sum).exp();  // (23)
    }
    return posterior;
  }

  /// (26)-(29).
  void maximizeMixture(const Posterior& posterior, Parameters& parameters) const {
    const Signals signals = computeSignals(parameters.theta);
    const auto kappa = static_cast<std::size_t>(parameters.mixture.components());
    const Matrix& zeta = posterior.responsibilities;
    double squares = 0, samples = 0;
    for (const auto length : lengths_) samples += static_cast<double>(length);
    for (std::size_t i = 0; i < kappa; ++i) {
      const auto column = static_cast<Eigen::Index>(i);
      const double total = zeta.col(column).sum();
      Vector mean = Vector::Zero(n_);
      for (Eigen::Index r = 0; r < zeta.rows(); ++r) {
        mean += zeta(r, column) * posterior.means[at(r, i, kappa)] / total;  // (27)
      }
      Matrix covariance = Matrix::Zero(n_, n_);
      for (Eigen::Index r = 0; r < zeta.rows(); ++r) {
        const Vector& m = posterior.means[at(r, i, kappa)];
        const Matrix& s = posterior.covariances[at(r, i, kappa)];
        covariance += zeta(r, column) / total * ((m - mean) * (m - mean).transpose() + s);  // (28)
        const auto psi = regressors(signals, r);
        squares += zeta(r, column) * ((residual(signals, r) - psi * m).squaredNorm() +
                                      (psi * s).cwiseProduct(psi).sum());  // (33)
      }
      parameters.mixture.weights[i] = total / static_cast<double>(zeta.rows());  // (26)
      parameters.mixture.means[i] = mean;
      parameters.mixture.covariances[i] = covariance;
    }
    parameters.noise_variance = squares / samples;  // (29)
  }

  /// Vector whose squared norm is the sum over r and i of zeta_ir B_ir, (35).
  Vector weightedResiduals(const Vector& theta, const Matrix& zeta,
                           const Posterior& posterior) const {
    const Signals signals = computeSignals(theta);
    const auto kappa = static_cast<std::size_t>(zeta.cols());
    Vector stack(outputs_.rows() * zeta.size() * (n_ + 1));
    Eigen::Index position = 0;
    for (Eigen::Index r = 0; r < zeta.rows(); ++r) {
      const auto psi = regressors(signals, r);
      for (std::size_t i = 0; i < kappa; ++i) {
        const double weight = std::sqrt(zeta(r, static_cast<Eigen::Index>(i)));
        const Eigen::SelfAdjointEigenSolver<Matrix> eigen(posterior.covariances[at(r, i, kappa)]);
        const Matrix root =
            eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
        stack.segment(position, psi.rows()) =
            weight * (residual(signals, r) - psi * posterior.means[at(r, i, kappa)]);
        position += psi.rows();
        for (Eigen::Index k = 0; k < n_; ++k, position += psi.rows()) {
          stack.segment(position, psi.rows()) = weight * (psi * root.col(k));
        }
      }
    }
    return stack.head(position);
  }

  /// (34): Gauss-Newton with a forward-difference Jacobian and step halving.
  Vector minimizeTheta(Vector theta, const Matrix& zeta, const Posterior& posterior) const {
    Vector residuals = weightedResiduals(theta, zeta, posterior);
    for (int step = 0; step < 20; ++step) {
      Matrix jacobian(residuals.size(), theta.size());
      for (Eigen::Index j = 0; j < theta.size(); ++j) {
        Vector moved = theta;
        moved[j] += 1e-7 * std::max(1.0, std::abs(theta[j]));
        jacobian.col(j) =
            (weightedResiduals(moved, zeta, posterior) - residuals) / (moved[j] - theta[j]);
      }
      const Matrix normal = jacobian.transpose() * jacobian;
      Vector direction = -normal.ldlt().solve(jacobian.transpose() * residuals);
      const double before = residuals.squaredNorm();
      Vector moved = weightedResiduals(theta + direction, zeta, posterior);
      for (int halving = 0; !(moved.squaredNorm() <= before); ++halving) {
        if (halving == 30) return theta;
        direction *= 0.5;
        moved = weightedResiduals(theta + direction, zeta, posterior);
      }
      theta += direction;
      residuals = moved;
      if (before - residuals.squaredNorm() < 1e-10 * before) break;
    }
    return theta;
  }

  /// One pass of Algorithm 1. Returns the log-likelihood of the parameters it began with.
  double iterate(Parameters& parameters) const {
    const Posterior posterior = expectation(parameters);
    maximizeMixture(posterior, parameters);
    const Posterior updated = expectation(parameters);  // (31), (32) at gamma^(m+1), for (35)
    parameters.theta = minimizeTheta(parameters.theta, posterior.responsibilities, updated);
    return posterior.log_likelihood;
  }

  static std::size_t at(Eigen::Index r, std::size_t i, std::size_t kappa) {
    return static_cast<std::size_t>(r) * kappa + i;
  }

  Orders orders_;
  Eigen::Index n_;
  std::vector<Eigen::Index> lengths_;
  Matrix inputs_, outputs_;  ///< N x M, shorter experiments padded with zeros
  Matrix filtered_inputs_;   ///< F(u_r) T of all experiments (N x M n)
};

}  // namespace uncertainty_identification::literal
