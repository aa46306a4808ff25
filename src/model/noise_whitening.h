#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/model/block.h"

namespace uncertainty_identification {

/// Whitens signals of a block by the inverse noise model H^-1 = D/C. The result is exact also if
/// the noise was present before the first sample (NoiseStart::stationary) and if outputs are
/// missing.
///
/// A Kalman filter with sigma^2 = 1 follows H in innovations form, s' = F s + K w, v = s_1 + w. Its
/// gain and innovation variance depend only on C, D and on which samples were measured, so one
/// recursion serves all signals:
///     nu_t = v_t - s_1,   s_i' = s_(i+1) + g_i(t) nu_t - d_i v_t,   e_t = nu_t / sqrt(S_t)
/// where g_i(t) tends to c_i as the initial state is forgotten. At a missing sample nu_t = 0, and
/// v_t is replaced by its prediction s_1. This is equivalent to the columns for start and gaps in
/// docs/method.md. log_jacobian = -1/2 sum ln S_t over the measured samples.
class NoiseWhitening {
 public:
  /// The first `first` samples are left out of the likelihood; the noise starts at sample `first`.
  /// With `derivatives`, the derivatives with respect to c1.., d1.. are prepared. The block must
  /// outlive this object.
  NoiseWhitening(const Eigen::VectorXd& c, const Eigen::VectorXd& d, NoiseStart start, int first,
                 const Block& block, bool derivatives);

  /// Computes e, the whitened signal v, over the samples of v, which may be fewer than the block's.
  void apply(const Signals& v, Signals* e) const;

  /// Also computes de/d(c1.., d1..), nc + nd signals, for a v that does not depend on c and d.
  void apply(const Signals& v, Signals* e, std::vector<Signals>* derivatives) const;

  /// -1/2 sum ln S_t for each lane, and its derivatives with respect to c1.., d1...
  const Lanes& logJacobian() const { return log_jacobian_; }
  const std::vector<Lanes>& logJacobianDerivatives() const { return log_jacobian_derivatives_; }

  /// Number of measured samples that count in the likelihood, for each lane.
  const Lanes& effectiveSamples() const { return effective_samples_; }

  int parameters() const { return nc_ + nd_; }

 private:
  void shareGains(const Eigen::MatrixXd& gains);
  void addLogJacobian(int lane, int end);
  void setGains(int lane, const Eigen::MatrixXd& gains);

  /// 1/sqrt(S_t), or its derivative with respect to a parameter; -1: the value itself.
  const Signals& scaleOf(int parameter) const;

  /// The signals g_i(t), or their derivatives; none if the gains do not vary.
  std::vector<const double*> gainsOf(int parameter) const;

  int order_, nc_, nd_, first_;
  Eigen::VectorXd c_, d_;  ///< padded to order_
  const Block& block_;
  int varying_ = 0;             ///< number of samples after which the gains have converged
  std::vector<Signals> gains_;  ///< rows of kalmanGains() while the gains vary, for each lane
  Lanes log_jacobian_, effective_samples_;
  std::vector<Lanes> log_jacobian_derivatives_;
};

}  // namespace uncertainty_identification
