#include "model/noise_whitening.h"

#include <algorithm>
#include <cmath>

#include "math/innovations_form.h"
#include "model/pack.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Derivative of the Riccati recursion of InnovationsForm in the direction (dF, dK).
struct RiccatiDerivative {
  VectorXd dd, dK;  ///< derivatives of d (F = [-d | shift]) and K
  MatrixXd dP;
  double dS = 0;
  VectorXd dgain;

  /// Must be called before `base.step()`, while `base` still holds P of this step. Computes the
  /// derivatives of S and gain.
  void step(const InnovationsForm& base, bool measured) {
    const MatrixXd& P = base.P;
    const double S = P(0, 0) + 1;
    const VectorXd gain = (base.F * P.col(0) + base.K) / S;
    dS = dP(0, 0);
    dgain = (base.F * dP.col(0) - dd * P(0, 0) + dK - gain * dS) / S;
    const MatrixXd moved = -dd * (P.row(0) * base.F.transpose());  // dF P F'
    MatrixXd next = base.F * dP * base.F.transpose() + moved + moved.transpose() +
                    dK * base.K.transpose() + base.K * dK.transpose();
    if (measured) {
      next -=
          S * (dgain * gain.transpose() + gain * dgain.transpose()) + dS * gain * gain.transpose();
    }
    dP = next;
  }
};

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

/// Filters one signal. Stores the innovations nu and the effective v (with predictions at missing
/// samples), which the derivatives need.
UI_VECTOR_CLONES
void whiten(const View& f, const Pack* v, Pack* e, Pack* nu, Pack* effective, Pack* state) {
  const int m = f.order;
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
    nu[t] = innovation;
    effective[t] = value;
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
      start_(start),
      c_(padded(c, order_)),
      d_(padded(d, order_)),
      block_(block),
      derivatives_(derivatives),
      log_jacobian_(Lanes::Zero()) {
  effective_samples_ = block.weight.rightCols(block.samples - first_).rowwise().sum();
  if (derivatives_)
    log_jacobian_derivatives_.assign(static_cast<std::size_t>(nc_ + nd_), Lanes::Zero());
  if (order_ == 0 || (start_ == NoiseStart::zero && !block.gaps)) return;

  gains_.assign(static_cast<std::size_t>(order_), Signals(kLanes, block.samples));
  for (int i = 0; i < order_; ++i) gains_[static_cast<std::size_t>(i)].setConstant(c_[i]);
  scale_.setOnes(kLanes, block.samples);
  if (derivatives_) {
    gain_derivatives_.resize(static_cast<std::size_t>(nc_ + nd_));
    for (int j = 0; j < nc_ + nd_; ++j) {
      auto& of_parameter = gain_derivatives_[static_cast<std::size_t>(j)];
      of_parameter.assign(static_cast<std::size_t>(order_), Signals::Zero(kLanes, block.samples));
      if (j < nc_) of_parameter[static_cast<std::size_t>(j)].setOnes();
    }
    scale_derivatives_.assign(static_cast<std::size_t>(nc_ + nd_),
                              Signals::Zero(kLanes, block.samples));
  }
  MatrixXd P0;
  std::vector<MatrixXd> dP0;
  prepareStart(&P0, &dP0);
  for (int lane = 0; lane < block.lanes; ++lane) recursion(lane, P0, dP0);
}

void NoiseWhitening::prepareStart(MatrixXd* P0, std::vector<MatrixXd>* dP0) const {
  const InnovationsForm form(c_, d_);
  const MatrixXd& F = form.F;
  const VectorXd& K = form.K;
  *P0 = start_ == NoiseStart::stationary ? form.stationaryCovariance() : form.P;
  if (!derivatives_) return;
  for (int j = 0; j < nc_ + nd_; ++j) {
    dP0->push_back(MatrixXd::Zero(order_, order_));
    if (start_ != NoiseStart::stationary) continue;
    const bool of_c = j < nc_;
    const VectorXd dd =
        of_c ? VectorXd(VectorXd::Zero(order_)) : VectorXd(VectorXd::Unit(order_, j - nc_));
    const VectorXd dK = of_c ? VectorXd(VectorXd::Unit(order_, j)) : VectorXd(-dd);
    const MatrixXd moved = -dd * (P0->row(0) * F.transpose());
    dP0->back() =
        solveLyapunov(F, moved + moved.transpose() + dK * K.transpose() + K * dK.transpose());
  }
}

void NoiseWhitening::recursion(int lane, const MatrixXd& P0, const std::vector<MatrixXd>& dP0) {
  if (lane > 0 &&
      !block_.gaps) {  // without gaps all lanes share the gains of the first, which is the longest
    for (Signals& gain : gains_) gain.row(lane) = gain.row(0);
    scale_.row(lane) = scale_.row(0);
    const int end = std::min(varying_, block_.lengths[static_cast<std::size_t>(lane)]);
    const int count = std::max(end - first_, 0);
    log_jacobian_[lane] = scale_.row(0).segment(first_, count).log().sum();
    for (std::size_t j = 0; j < scale_derivatives_.size(); ++j) {
      for (Signals& gain : gain_derivatives_[j]) gain.row(lane) = gain.row(0);
      scale_derivatives_[j].row(lane) = scale_derivatives_[j].row(0);
      log_jacobian_derivatives_[j][lane] = (scale_derivatives_[j].row(0).segment(first_, count) /
                                            scale_.row(0).segment(first_, count))
                                               .sum();
    }
    return;
  }
  InnovationsForm base(c_, d_);
  base.P = P0;
  std::vector<RiccatiDerivative> tangents;
  for (int j = 0; derivatives_ && j < nc_ + nd_; ++j) {
    const VectorXd unit = VectorXd::Unit(order_, j < nc_ ? j : j - nc_);
    const VectorXd dd = j < nc_ ? VectorXd(0 * unit) : unit;
    tangents.push_back(
        {dd, j < nc_ ? unit : VectorXd(-unit), dP0[static_cast<std::size_t>(j)], 0, VectorXd()});
  }
  const int end = block_.lengths[static_cast<std::size_t>(lane)];
  for (int t = first_; t < end; ++t) {
    const bool measured = block_.weight(lane, t) != 0;
    for (std::size_t j = 0; j < tangents.size(); ++j) tangents[j].step(base, measured);
    base.step(measured);
    scale_(lane, t) = 1 / std::sqrt(base.S);
    double change = base.P.cwiseAbs().maxCoeff();
    for (int i = 0; i < order_; ++i)
      gains_[static_cast<std::size_t>(i)](lane, t) = base.gain[i] + d_[i];
    if (measured) log_jacobian_[lane] -= 0.5 * std::log(base.S);
    for (std::size_t j = 0; j < tangents.size(); ++j) {
      const RiccatiDerivative& tangent = tangents[j];
      for (int i = 0; i < order_; ++i) {
        gain_derivatives_[j][static_cast<std::size_t>(i)](lane, t) =
            tangent.dgain[i] + tangent.dd[i];
      }
      scale_derivatives_[j](lane, t) = -0.5 * tangent.dS / (base.S * std::sqrt(base.S));
      if (measured) log_jacobian_derivatives_[j][lane] -= 0.5 * tangent.dS / base.S;
      change = std::max(change, tangent.dP.cwiseAbs().maxCoeff());
    }
    varying_ = std::max(varying_, t + 1);
    if (!block_.gaps && change < 1e-17) break;  // P = 0: the initial state is forgotten
  }
}

void NoiseWhitening::apply(const Signals& v, Signals* e) const { apply(v, e, nullptr); }

void NoiseWhitening::apply(const Signals& v, Signals* e, std::vector<Signals>* derivatives) const {
  e->setZero(kLanes, v.cols());
  if (order_ == 0) {
    e->rightCols(v.cols() - first_) = (v * block_.weight).rightCols(v.cols() - first_);
    return;
  }
  std::vector<const double*> gains;
  for (const Signals& gain : gains_) gains.push_back(gain.data());
  const View view{order_,
                  static_cast<int>(v.cols()),
                  first_,
                  varying_,
                  c_.data(),
                  d_.data(),
                  gains.data(),
                  packs(scale_),
                  packs(block_.weight),
                  block_.gaps};
  Signals nu(kLanes, v.cols()), effective(kLanes, v.cols()), state(kLanes, order_ + 1);
  whiten(view, packs(v), packs(e), packs(&nu), packs(&effective), packs(&state));
  if (derivatives == nullptr) return;
  derivatives->resize(static_cast<std::size_t>(nc_ + nd_));
  for (int j = 0; j < nc_ + nd_; ++j) {
    const auto at = static_cast<std::size_t>(j);
    std::vector<const double*> dgains;
    const Pack* dscale = nullptr;
    if (varying_ > 0) {
      for (const Signals& gain : gain_derivatives_[at]) dgains.push_back(gain.data());
      dscale = packs(scale_derivatives_[at]);
    }
    (*derivatives)[at].setZero(kLanes, v.cols());
    whitenDerivative(view, j < nc_, j < nc_ ? j : j - nc_, dgains.data(), dscale, packs(nu),
                     packs(effective), packs(&(*derivatives)[at]), packs(&state));
  }
}

}  // namespace uncertainty_identification
