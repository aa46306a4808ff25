#include "detection/whitened_stream.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"
#include "model/evaluation.h"
#include "model/sensitivity.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// q^-delay B as one polynomial.
VectorXd delayed(int delay, const VectorXd& b) {
  VectorXd numerator = VectorXd::Zero(delay + b.size());
  numerator.tail(b.size()) = b;
  return numerator;
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
                                 Index signals)
    : c_(padded(c, std::max(c.size(), d.size()))),
      d_(padded(d, c_.size())),
      gain_(c_),
      noise_(c_, d_),
      state_(MatrixXd::Zero(c_.size() + 1, signals)) {  // the last row stays 0
  if (start == NoiseStart::stationary && c_.size() > 0) noise_.P = noise_.stationaryCovariance();
  settled_ = c_.size() == 0 || noise_.P.cwiseAbs().maxCoeff() < 1e-17;
}

void StreamWhitening::step(bool measured, VectorXd* signals) {
  const Index order = d_.size();
  double scale = 1;
  if (!settled_ || (!measured && order > 0)) {
    noise_.step(measured);
    scale = 1 / std::sqrt(noise_.S);
    gain_ = noise_.gain + d_;
    settled_ = noise_.P.cwiseAbs().maxCoeff() < 1e-17;
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
  if (estimatesInitialState(options)) initial_ = VectorXd::Zero(model.free_directions);
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
