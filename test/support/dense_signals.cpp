#include "support/dense_signals.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification::dense {
namespace {

/// Number of leading values that hold all of the signal but what lies below 1e-30 of its maximum.
Eigen::Index significantSamples(const Vector& signal) {
  const Real threshold = signal.cwiseAbs().maxCoeff() * 1e-30L;
  Eigen::Index count = signal.size();
  while (count > 1 && std::abs(signal[count - 1]) <= threshold) --count;
  return count;
}

}  // namespace

Eigen::VectorXd monic(const Eigen::VectorXd& tail) {
  Eigen::VectorXd full(tail.size() + 1);
  full << 1.0, tail;
  return full;
}

Eigen::VectorXd product(const Eigen::VectorXd& p, const Eigen::VectorXd& q) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(p.size() + q.size() - 1);
  for (Eigen::Index i = 0; i < p.size(); ++i) result.segment(i, q.size()) += p[i] * q;
  return result;
}

Vector impulseResponse(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator,
                       int delay, int samples) {
  Vector h = Vector::Zero(samples);
  for (Eigen::Index t = delay; t < samples; ++t) {
    if (t - delay < numerator.size()) h[t] = numerator[t - delay];
    const Eigen::Index reach = std::min<Eigen::Index>(denominator.size() - 1, t - delay);
    for (Eigen::Index k = 1; k <= reach; ++k) h[t] -= Real(denominator[k]) * h[t - k];
  }
  return h;
}

Matrix toeplitz(const Vector& impulse_response) {
  const Eigen::Index samples = impulse_response.size();
  Matrix matrix = Matrix::Zero(samples, samples);
  for (Eigen::Index j = 0; j < samples; ++j) {
    matrix.col(j).tail(samples - j) = impulse_response.head(samples - j);
  }
  return matrix;
}

Vector autocovariance(const Eigen::VectorXd& c, const Eigen::VectorXd& d, int lags, int terms) {
  const Vector h = impulseResponse(monic(c), monic(d), 0, terms);
  const Eigen::Index count = significantSamples(h);
  Vector result = Vector::Zero(lags);
  for (Eigen::Index lag = 0; lag < std::min<Eigen::Index>(lags, count); ++lag) {
    result[lag] = h.segment(lag, count - lag).dot(h.head(count - lag));
  }
  return result;
}

Eigen::MatrixXd firBasis(int taps, int samples) { return Eigen::MatrixXd::Identity(samples, taps); }

Eigen::MatrixXd laguerreBasis(double pole, int taps, int samples) {
  const Eigen::VectorXd denominator = Eigen::Vector2d(1.0, -pole);
  const Eigen::VectorXd all_pass_numerator = Eigen::Vector2d(-pole, 1.0);
  Eigen::VectorXd all_numerator = Eigen::VectorXd::Constant(1, std::sqrt(1.0 - pole * pole));
  Eigen::VectorXd all_denominator = denominator;
  Eigen::MatrixXd basis(samples, taps);
  for (int k = 0; k < taps; ++k) {
    basis.col(k) = impulseResponse(all_numerator, all_denominator, 0, samples).cast<double>();
    all_numerator = product(all_numerator, all_pass_numerator);
    all_denominator = product(all_denominator, denominator);
  }
  return basis;
}

Eigen::MatrixXd kautzBasis(double pole_real, double pole_imag, int taps, int samples) {
  const double c = -(pole_real * pole_real + pole_imag * pole_imag);
  const double b = 2 * pole_real / (1 - c);
  const Eigen::VectorXd denominator = Eigen::Vector3d(1.0, b * (c - 1), -c);
  const Eigen::VectorXd all_pass_numerator = denominator.reverse();
  const double gain = std::sqrt(1 - c * c);
  const Eigen::VectorXd odd = gain * Eigen::Vector2d(1.0, -b);
  const Eigen::VectorXd even = gain * std::sqrt(1 - b * b) * Eigen::Vector2d(0.0, 1.0);
  Eigen::VectorXd chain_numerator = Eigen::VectorXd::Ones(1), chain_denominator = denominator;
  Eigen::MatrixXd basis(samples, taps);
  for (int k = 0; k < taps; ++k) {
    const Eigen::VectorXd numerator = product(chain_numerator, k % 2 == 0 ? odd : even);
    basis.col(k) = impulseResponse(numerator, chain_denominator, 0, samples).cast<double>();
    if (k % 2 == 0) continue;
    chain_numerator = product(chain_numerator, all_pass_numerator);
    chain_denominator = product(chain_denominator, denominator);
  }
  return basis;
}

}  // namespace uncertainty_identification::dense
