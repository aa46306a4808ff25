#include "detection/whitened_stream.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"
#include "model/sensitivity.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd padded(const VectorXd& from, Index size) {
  VectorXd to = VectorXd::Zero(size);
  to.head(from.size()) = from;
  return to;
}

/// q^-delay B as one polynomial.
VectorXd delayed(int delay, const VectorXd& b) {
  VectorXd numerator = VectorXd::Zero(delay + b.size());
  numerator.tail(b.size()) = b;
  return numerator;
}

/// Stationary covariance P = F P F' + Q by doubling, as NoiseWhitening starts.
MatrixXd stationary(MatrixXd F, MatrixXd Q) {
  for (int step = 0; step < 60; ++step) {
    const MatrixXd increment = F * Q * F.transpose();
    Q += increment;
    if (increment.cwiseAbs().maxCoeff() <= 1e-17 * Q.cwiseAbs().maxCoeff()) break;
    F = (F * F).eval();
  }
  return Q;
}

/// Observer form of H: F = [-d | shift].
MatrixXd transition(const VectorXd& d) {
  MatrixXd F = MatrixXd::Zero(d.size(), d.size());
  F.diagonal(1).setOnes();
  F.col(0) = -d;
  return F;
}

}  // namespace

StreamFilter::StreamFilter(const VectorXd& numerator, const VectorXd& monic_denominator) {
  const Index order = std::max<Index>(numerator.size() - 1, monic_denominator.size());
  numerator_ = padded(numerator, order + 1);
  denominator_ = padded(monic_denominator, order);
  state_ = VectorXd::Zero(order + 1);  // the last entry stays 0
}

double StreamFilter::step(double in) {
  const double out = numerator_[0] * in + state_[0];
  for (Index i = 0; i < denominator_.size(); ++i)
    state_[i] = state_[i + 1] + numerator_[i + 1] * in - denominator_[i] * out;
  return out;
}

StreamWhitening::StreamWhitening(const VectorXd& c, const VectorXd& d, NoiseStart start,
                                 Index signals) {
  const Index order = std::max(c.size(), d.size());
  c_ = padded(c, order);
  d_ = padded(d, order);
  gain_ = c_;
  state_ = MatrixXd::Zero(order + 1, signals);  // the last row stays 0
  covariance_ = MatrixXd::Zero(order, order);
  const VectorXd K = c_ - d_;
  if (start == NoiseStart::stationary && order > 0)
    covariance_ = stationary(transition(d_), K * K.transpose());
  settled_ = order == 0 || covariance_.cwiseAbs().maxCoeff() < 1e-17;
}

void StreamWhitening::step(bool measured, VectorXd* signals) {
  const Index order = d_.size();
  double scale = 1;
  if (!settled_ || (!measured && order > 0)) {
    const MatrixXd F = transition(d_);
    const VectorXd K = c_ - d_;
    const double S = covariance_(0, 0) + 1;
    const VectorXd gain = (F * covariance_.col(0) + K) / S;
    covariance_ = (F * covariance_ * F.transpose() + K * K.transpose()).eval();
    if (measured) covariance_ -= S * gain * gain.transpose();
    scale = 1 / std::sqrt(S);
    gain_ = gain + d_;
    settled_ = covariance_.cwiseAbs().maxCoeff() < 1e-17;
  } else if (order > 0) {
    gain_ = c_;
  }
  for (Index j = 0; j < signals->size(); ++j) {
    const double predicted = state_(0, j);
    const double value = measured ? (*signals)[j] : predicted;
    const double innovation = value - predicted;
    for (Index i = 0; i < order; ++i)
      state_(i, j) = state_(i + 1, j) + gain_[i] * innovation - d_[i] * value;
    (*signals)[j] = innovation * scale;
  }
}

StreamModel streamModel(const Polynomials& p, const RationalBasis& basis) {
  const Index poles = basis.denominator.size();
  const Index zeros = poles > 0 ? poles : std::max<Index>(basis.taps - 1, 0);
  return {p,
          basis.numerators,
          basis.denominator,
          false,
          multiply(p.a, basis.denominator),
          std::max<Index>(p.a.size() + poles, p.delay + p.b.size() - 1 + zeros)};
}

StreamModel streamModel(const NominalModel& nominal, const ErrorModelOptions& options,
                        const VectorXd& theta) {
  const int order = options.sensitivity_order;
  const SensitivityNumerators all =
      sensitivityNumerators(nominal, sensitivityTerms(nominal, options), order, theta);
  StreamModel model;
  model.polynomials = nominal.polynomials(theta);
  for (Index i = 0; i < all.terms.cols(); ++i)
    model.regressors.push_back(delayed(all.delay, all.terms.col(i)));
  model.regressor_denominator = model.free_denominator = all.denominator;
  model.regressors_of_input = true;
  const Index na = model.polynomials.a.size(), nb = model.polynomials.b.size();
  model.free_directions = std::max<Index>((order + 1) * na, all.delay + nb - 1 + order * na);
  return model;
}

WhitenedStream::WhitenedStream(const StreamModel& model, const EstimationOptions& options,
                               double offset_u, double offset_y)
    : plant_(delayed(model.polynomials.delay, model.polynomials.b), model.polynomials.a),
      own_offset_plant_(plant_),
      free_response_(VectorXd::Ones(1), model.free_denominator),
      regressors_of_input_(model.regressors_of_input),
      own_offset_(options.offsets == Offsets::per_experiment),
      offset_at_input_(options.offset_side == OffsetSide::input),
      offset_u_(offset_u),
      offset_y_(offset_y),
      discard_(options.initial_state == InitialState::discard ? options.discard_samples : 0),
      whitening_(model.polynomials.c, model.polynomials.d, options.noise_start, 0) {
  for (const VectorXd& numerator : model.regressors)
    basis_.emplace_back(numerator, model.regressor_denominator);
  if (options.initial_state == InitialState::estimate)
    initial_ = VectorXd::Zero(model.free_directions);
  signals_ = VectorXd::Zero(2 + regressors() + columns());
  whitening_ = StreamWhitening(model.polynomials.c, model.polynomials.d, options.noise_start,
                               signals_.size());
}

const VectorXd& WhitenedStream::step(double u, double y) {
  const double x = plant_.step(u + offset_u_);
  signals_[0] = y - x - offset_y_;
  signals_[1] = x;
  Index next = 2;
  const double source = regressors_of_input_ ? u + offset_u_ : x;
  for (StreamFilter& filter : basis_) signals_[next++] = filter.step(source);
  if (initial_.size() > 0) {
    for (Index k = initial_.size() - 1; k > 0; --k) initial_[k] = initial_[k - 1];
    initial_[0] = free_response_.step(first_ ? 1 : 0);
    signals_.segment(next, initial_.size()) = initial_;
    next += initial_.size();
  }
  if (own_offset_) signals_[next] = offset_at_input_ ? own_offset_plant_.step(1) : 1;
  first_ = false;
  measured_ = std::isfinite(y) && discard_ == 0;
  if (discard_ > 0) {
    --discard_;
    signals_.setZero();
  } else {
    whitening_.step(measured_, &signals_);
  }
  return signals_;
}

}  // namespace uncertainty_identification
