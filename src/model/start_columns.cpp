#include "model/start_columns.h"

#include <algorithm>
#include <cmath>

#include "math/innovations_form.h"
#include "math/pseudo_inverse.h"
#include "math/symmetric_eigen.h"
#include "model/evaluation.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

CoefficientLayout::CoefficientLayout(const Polynomials& p)
    : a(p.b.size()), c(a + p.a.size()), d(c + p.c.size()), size(d + p.d.size()) {}

NoiseStartCovariance::NoiseStartCovariance(const Polynomials& p, bool with_derivatives) {
  const Index order = std::max(p.c.size(), p.d.size());
  const InnovationsForm form(padded(p.c, order), padded(p.d, order));
  value = form.stationaryCovariance();
  VectorXd variances = value.diagonal();
  MatrixXd directions = MatrixXd::Identity(order, order);
  if (order > 1) {
    const SymmetricEigen eigen(value);
    variances = eigen.eigenvalues();
    directions = eigen.eigenvectors();
  }
  const VectorXd deviations = variances.cwiseMax(0).cwiseSqrt();
  root = directions * deviations.asDiagonal();
  constexpr double kSingular = 1e-7;  // relative, of standard deviations: rounding of the variances
  if (deviations.minCoeff() > kSingular * deviations.maxCoeff())
    inverse_root = deviations.cwiseInverse().asDiagonal() * directions.transpose();
  for (Index j = 0; with_derivatives && j < p.c.size() + p.d.size(); ++j) {
    MatrixXd dF = MatrixXd::Zero(order, order);  // F = [-d | shift], K = c - d
    VectorXd dK = VectorXd::Zero(order);
    if (j < p.c.size()) {
      dK[j] = 1;
    } else {
      dK[j - p.c.size()] = dF(j - p.c.size(), 0) = -1;
    }
    const MatrixXd moved = dF * value * form.F.transpose() + dK * form.K.transpose();
    derivatives.push_back(solveLyapunov(form.F, moved + moved.transpose()));
  }
}

namespace {

/// Number of samples after which two signals have vanished within rounding.
int vanishing(const std::optional<SharedSignal>& one, const std::optional<SharedSignal>& other) {
  constexpr double kVanished = 1e-17;
  int last = 0;
  for (const auto* signal : {&one, &other}) {
    if (!*signal) continue;
    const double* values = (*signal)->delayed(0);
    double largest = 0;
    for (int t = 0; t < (*signal)->samples(); ++t) largest = std::max(largest, std::abs(values[t]));
    int end = (*signal)->samples();
    while (end > 0 && std::abs(values[end - 1]) <= kVanished * largest) --end;
    last = std::max(last, end);
  }
  return last;
}

}  // namespace

StartColumns::StartColumns(const Polynomials& p, int states, const EstimationOptions& options,
                           std::vector<int> lengths, bool derivatives)
    : states_(states),
      precision_(std::max(0.0, options.initial_precision)),
      samples_of_prior_(samplesOfPrior(options)),
      log_prior_(logOfPrior(options)) {
  const bool own_offset = options.offsets == Offsets::per_experiment;
  if (options.noise_start == NoiseStart::stationary)
    noise_ = static_cast<int>(std::max(p.c.size(), p.d.size()));
  const int longest = *std::max_element(lengths.begin(), lengths.end());
  const int order = static_cast<int>(std::max({p.a.size(), p.c.size(), p.d.size()}));
  const int lag = std::max(states_, noise_) + order + 1;
  const int decay =  // of the derivatives, too
      std::min(longest, decayOf({p.a, p.a, p.c, p.c}, longest) + static_cast<int>(p.d.size()));
  const SharedSignal over_c = SharedSignal::impulse(decay, lag).dividedBy(p.c);
  if (noise_ > 0) {
    start_ = NoiseStartCovariance(p, derivatives);
    of_noise_ = over_c;
  }
  if (states_ > 0) of_state_ = over_c.dividedBy(p.a).times(p.d);
  if (own_offset) step_ = SharedSignal::step(longest, lag).dividedBy(p.c).times(p.d);
  duration_ = std::min(vanishing(of_noise_, of_state_) + std::max(states_, noise_), longest);
  longest_ = own_offset ? longest : duration_;
  prepare(p, lag, std::move(lengths), derivatives);
}

const double* StartColumns::column(int k) const {
  if (k < noise_) return of_noise_->delayed(k);
  if (k < noise_ + states_) return of_state_->delayed(k - noise_);
  return step_->delayed(0);
}

std::vector<StartColumns::Family> StartColumns::families(const Polynomials& p,
                                                         const CoefficientLayout& layout, int lag,
                                                         bool derivatives) const {
  const int na = static_cast<int>(p.a.size()), nc = static_cast<int>(p.c.size()),
            nd = static_cast<int>(p.d.size());
  std::vector<Family> all;
  if (of_noise_) all.push_back({0, noise_, &*of_noise_, {}});
  if (of_noise_ && derivatives && nc > 0)
    all.back().derivatives.push_back({layout.c, nc, -1, of_noise_->dividedBy(p.c)});
  if (of_state_) all.push_back({noise_, states_, &*of_state_, {}});
  if (of_state_ && derivatives) {
    auto& of_state = all.back().derivatives;
    if (na > 0) of_state.push_back({layout.a, na, -1, of_state_->dividedBy(p.a)});
    if (nc > 0) of_state.push_back({layout.c, nc, -1, of_state_->dividedBy(p.c)});
    const SharedSignal impulse = SharedSignal::impulse(of_state_->samples(), lag);
    if (nd > 0) of_state.push_back({layout.d, nd, 1, impulse.dividedBy(p.c).dividedBy(p.a)});
  }
  if (step_) all.push_back({noise_ + states_, 1, &*step_, {}});
  if (step_ && derivatives) {
    auto& of_step = all.back().derivatives;
    if (nc > 0) of_step.push_back({layout.c, nc, -1, step_->dividedBy(p.c)});
    const SharedSignal step = SharedSignal::step(step_->samples(), lag);
    if (nd > 0) of_step.push_back({layout.d, nd, 1, step.dividedBy(p.c)});
  }
  return all;
}

/// Integrates over the columns' coefficients, given Z'Z. With s = root zeta for the noise's state,
/// zeta has precision 1.
StartColumns::Absorption StartColumns::absorb(const MatrixXd& gram) const {
  const Index size = gram.rows(), m = noise_;
  MatrixXd root = MatrixXd::Identity(size, size);
  if (m > 0) root.topLeftCorner(m, m) = start_.root;
  VectorXd precision = VectorXd::Constant(size, precision_);
  precision.head(m).setOnes();
  MatrixXd inner = root.transpose() * gram * root;
  inner.diagonal() += precision;
  const PseudoInverse pseudo(inner);
  const MatrixXd scaled = pseudo.inverse * root.transpose();  // zeta = scaled Z'signal
  Absorption made;
  made.estimate = root * scaled;
  made.prior = scaled.transpose() * precision.asDiagonal() * scaled;
  if (m > 0 && start_.inverse_root.size() > 0) {  // without the cancellation of the general formula
    made.noise_residual = start_.inverse_root.transpose() * scaled.topRows(m);
    made.noise_gram = start_.inverse_root.transpose() *
                      (MatrixXd::Identity(m, m) - pseudo.inverse.topLeftCorner(m, m)) *
                      start_.inverse_root;
  } else {
    made.noise_residual = MatrixXd::Identity(m, size) - gram.topRows(m) * made.estimate;
    made.noise_gram = made.noise_residual * gram.leftCols(m);
  }
  made.log_jacobian = -0.5 * pseudo.log_determinant;
  if (precision_ > 0) {
    const auto columns = static_cast<double>(size - m);
    made.log_jacobian += columns * (0.5 * std::log(precision_) - log_prior_);
    made.lost_samples = columns * samples_of_prior_;
  } else {
    made.lost_samples = static_cast<double>(pseudo.rank - m);
  }
  return made;
}

void StartColumns::prepare(const Polynomials& p, int lag, std::vector<int> lengths,
                           bool derivatives) {
  if (count() == 0) return;
  for (int& length : lengths) length = std::min(length, longest_);
  std::sort(lengths.begin(), lengths.end());
  lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
  const CoefficientLayout layout(p);
  const std::vector<Family> all = families(p, layout, lag, derivatives);
  std::vector<LaggedProducts> values, changes;  // in the order of the loops below
  for (const Family& one : all) {
    for (const Family& other : all) {
      values.emplace_back(*one.signal, one.count, *other.signal, other.count);
      for (const Derivative& to : one.derivatives)
        changes.emplace_back(to.signal, one.count + to.count, *other.signal, other.count);
    }
  }
  for (const int length : lengths) {
    MatrixXd gram(count(), count());
    auto value = values.begin();
    for (const Family& one : all) {
      for (const Family& other : all)
        gram.block(one.first, other.first, one.count, other.count) = (value++)->until(length);
    }
    Absorption made = absorb(gram);
    made.log_jacobian_derivatives = VectorXd::Zero(layout.size);
    auto change = changes.begin();
    for (const Family& one : all) {  // -1/2 tr(W d(Z'Z)) = -tr(W dZ'Z)
      for (const Family& other : all) {
        const auto weight = made.estimate.block(one.first, other.first, one.count, other.count);
        for (const Derivative& to : one.derivatives) {
          const MatrixXd products = (change++)->until(length);
          for (int j = 0; j < to.count; ++j) {
            made.log_jacobian_derivatives[to.first + j] -=
                to.sign * weight.cwiseProduct(products.middleRows(j + 1, one.count)).sum();
          }
        }
      }
    }
    for (std::size_t j = 0; j < start_.derivatives.size(); ++j) {
      made.log_jacobian_derivatives[layout.c + static_cast<Index>(j)] -=
          0.5 * made.noise_gram.cwiseProduct(start_.derivatives[j]).sum();
    }
    absorptions_.emplace_back(length, std::move(made));
  }
}

const StartColumns::Absorption& StartColumns::absorption(int length) const {
  const int key = std::min(length, longest_);
  const auto found = std::lower_bound(
      absorptions_.begin(), absorptions_.end(), key,
      [](const std::pair<int, Absorption>& one, int of) { return one.first < of; });
  return found->second;
}

}  // namespace uncertainty_identification
