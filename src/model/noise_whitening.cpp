#include "model/noise_whitening.h"

#include <algorithm>
#include <cmath>

#include "math/innovations_form.h"
#include "model/kalman_gains.h"
#include "model/pack.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// In place of a parameter: the value itself, not a derivative.
constexpr int kValue = -1;

struct View {
  int order, samples, first, varying;
  const double *c, *d;
  const double* const* gains;  ///< [i], packs over t < varying
  const Pack* scale;
  const Pack* weight;  ///< 0 at missing samples
  bool gaps;
};

inline const Pack& at(const double* const* signals, int i, int t) {
  return reinterpret_cast<const Pack*>(signals[i])[t];
}

/// What the derivatives need of a filtered signal: the innovations nu and the effective v (with
/// predictions at missing samples). Null pointers where no derivatives are wanted.
struct Kept {
  Pack *nu, *effective;
};

/// Filters one signal. `Order`: that of the noise model, so that its state stays in registers; 0:
/// any.
template <int Order>
UI_INLINE void whitenBy(const View& f, const Pack* v, Pack* e, const Kept& kept, Pack* any_state) {
  Pack own_state[Order + 1] = {};
  Pack* state = Order > 0 ? own_state : any_state;
  const int m = Order > 0 ? Order : f.order;
  for (int i = 0; i <= m; ++i) state[i] = Pack{};
  for (int t = f.first; t < f.samples; ++t) {
    const Pack predicted = state[0];
    const Pack value = f.gaps ? predicted + f.weight[t] * (v[t] - predicted) : v[t];
    const Pack innovation = value - predicted;
    if (t < f.varying) {
      for (int i = 0; i < m; ++i)
        state[i] = state[i + 1] + at(f.gains, i, t) * innovation - f.d[i] * value;
      e[t] = innovation * f.scale[t] * f.weight[t];
    } else {
      for (int i = 0; i < m; ++i) state[i] = state[i + 1] + f.c[i] * innovation - f.d[i] * value;
      e[t] = innovation * f.weight[t];
    }
    if (kept.nu == nullptr) continue;
    kept.nu[t] = innovation;
    kept.effective[t] = value;
  }
}

UI_VECTOR_CLONES
void whiten(const View& f, const Pack* v, Pack* e, const Kept& kept, Pack* state) {
  switch (f.order) {
    case 1:
      return whitenBy<1>(f, v, e, kept, state);
    case 2:
      return whitenBy<2>(f, v, e, kept, state);
    case 3:
      return whitenBy<3>(f, v, e, kept, state);
    default:
      return whitenBy<0>(f, v, e, kept, state);
  }
}

/// Derivative of the result of whiten() with respect to the coefficient with index `which` of C or
/// D.
UI_VECTOR_CLONES
void whitenDerivative(const View& f, bool of_c, int which, const double* const* dgains,
                      const Pack* dscale, const Pack* nu, const Pack* effective, Pack* de,
                      Pack* state) {
  const int m = f.order;
  for (int i = 0; i <= m; ++i) state[i] = Pack{};
  for (int t = f.first; t < f.samples; ++t) {
    const Pack dpredicted = state[0];
    const Pack dvalue = f.gaps ? dpredicted - f.weight[t] * dpredicted : Pack{};
    const Pack dnu = dvalue - dpredicted;
    if (t < f.varying) {
      for (int i = 0; i < m; ++i) {
        state[i] =
            state[i + 1] + at(f.gains, i, t) * dnu + at(dgains, i, t) * nu[t] - f.d[i] * dvalue;
      }
      de[t] = (dnu * f.scale[t] + nu[t] * dscale[t]) * f.weight[t];
    } else {
      for (int i = 0; i < m; ++i) state[i] = state[i + 1] + f.c[i] * dnu - f.d[i] * dvalue;
      if (of_c) state[which] += nu[t];
      de[t] = dnu * f.weight[t];
    }
    if (!of_c) state[which] -= effective[t];
  }
}

}  // namespace

NoiseWhitening::NoiseWhitening(const VectorXd& c, const VectorXd& d, NoiseStart start, int first,
                               const Block& block, bool derivatives)
    : order_(static_cast<int>(std::max(c.size(), d.size()))),
      nc_(static_cast<int>(c.size())),
      nd_(static_cast<int>(d.size())),
      first_(std::min(first, block.samples)),
      c_(padded(c, order_)),
      d_(padded(d, order_)),
      block_(block),
      log_jacobian_(Lanes::Zero()) {
  effective_samples_ = block.weight.rightCols(block.samples - first_).rowwise().sum();
  if (derivatives)
    log_jacobian_derivatives_.assign(static_cast<std::size_t>(nc_ + nd_), Lanes::Zero());
  if (order_ == 0 || (start == NoiseStart::zero && !block.gaps)) return;
  const NoisePolynomials noise{c_, d_, derivatives ? nc_ : 0, derivatives ? nd_ : 0, start};
  if (!block.gaps) {
    shareGains(kalmanGains(noise, block, 0, first_, true));
    return;
  }
  for (int lane = 0; lane < block.lanes; ++lane)
    setGains(lane, kalmanGains(noise, block, lane, first_, false));
}

/// Without gaps all lanes share the gains of the first, which is the longest.
void NoiseWhitening::shareGains(const MatrixXd& gains) {
  varying_ = static_cast<int>(gains.cols());
  for (Index row = 0; row < gains.rows(); ++row)
    gains_.push_back(gains.row(row).array().replicate(kLanes, 1));
  for (int lane = 0; lane < block_.lanes; ++lane) {
    const int end = std::min(varying_, block_.lengths[static_cast<std::size_t>(lane)]);
    const bool as_before = lane > 0 && end == varying_;
    if (!as_before) {
      addLogJacobian(lane, end);
      continue;
    }
    log_jacobian_[lane] = log_jacobian_[0];
    for (Lanes& derivative : log_jacobian_derivatives_) derivative[lane] = derivative[0];
  }
}

/// The first lane, which is the longest, decides how many samples are kept.
void NoiseWhitening::setGains(int lane, const MatrixXd& gains) {
  if (lane == 0) {
    varying_ = static_cast<int>(gains.cols());
    gains_.assign(static_cast<std::size_t>(gains.rows()), Signals::Zero(kLanes, varying_));
  }
  for (std::size_t row = 0; row < gains_.size(); ++row)
    gains_[row].row(lane).head(gains.cols()) = gains.row(static_cast<Index>(row)).array();
  addLogJacobian(lane, static_cast<int>(gains.cols()));
}

/// Of the measured samples before `end`.
void NoiseWhitening::addLogJacobian(int lane, int end) {
  for (int t = first_; t < end; ++t) {
    if (block_.weight(lane, t) == 0) continue;
    const double scale = scaleOf(kValue)(lane, t);
    log_jacobian_[lane] += std::log(scale);
    for (std::size_t j = 0; j < log_jacobian_derivatives_.size(); ++j)
      log_jacobian_derivatives_[j][lane] += scaleOf(static_cast<int>(j))(lane, t) / scale;
  }
}

const Signals& NoiseWhitening::scaleOf(int parameter) const {
  return gains_[static_cast<std::size_t>((order_ + 1) * (parameter + 1) + order_)];
}

std::vector<const double*> NoiseWhitening::gainsOf(int parameter) const {
  std::vector<const double*> gains;
  for (int i = 0; i < order_ && varying_ > 0; ++i)
    gains.push_back(gains_[static_cast<std::size_t>((order_ + 1) * (parameter + 1) + i)].data());
  return gains;
}

void NoiseWhitening::apply(const Signals& v, Signals* e) const { apply(v, e, nullptr); }

void NoiseWhitening::apply(const Signals& v, Signals* e, std::vector<Signals>* derivatives) const {
  e->resize(kLanes, v.cols());
  e->leftCols(std::min<Index>(first_, v.cols())).setZero();
  if (order_ == 0) {
    const Eigen::Index first = std::min<Eigen::Index>(first_, v.cols()), rest = v.cols() - first;
    e->rightCols(rest) = v.rightCols(rest) * block_.weight.middleCols(first, rest);
    return;
  }
  const std::vector<const double*> gains = gainsOf(kValue);
  const View view{order_,
                  static_cast<int>(v.cols()),
                  first_,
                  varying_,
                  c_.data(),
                  d_.data(),
                  gains.data(),
                  varying_ > 0 ? packs(scaleOf(kValue)) : nullptr,
                  packs(block_.weight),
                  block_.gaps};
  Signals nu, effective, state(kLanes, order_ + 1);
  if (derivatives == nullptr)
    return whiten(view, packs(v), packs(e), {nullptr, nullptr}, packs(&state));
  nu.resize(kLanes, v.cols());
  effective.resize(kLanes, v.cols());
  whiten(view, packs(v), packs(e), {packs(&nu), packs(&effective)}, packs(&state));
  derivatives->resize(static_cast<std::size_t>(nc_ + nd_));
  for (int j = 0; j < nc_ + nd_; ++j) {
    const auto at = static_cast<std::size_t>(j);
    const std::vector<const double*> dgains = gainsOf(j);
    const Pack* dscale = varying_ > 0 ? packs(scaleOf(j)) : nullptr;
    (*derivatives)[at].setZero(kLanes, v.cols());
    whitenDerivative(view, j < nc_, j < nc_ ? j : j - nc_, dgains.data(), dscale, packs(nu),
                     packs(effective), packs(&(*derivatives)[at]), packs(&state));
  }
}

}  // namespace uncertainty_identification
