#pragma once

#include <Eigen/Core>
#include <vector>

namespace uncertainty_identification {

/// A signal that all experiments share, because it depends on the parameters alone: the response of
/// a filter to an impulse or a step at sample 0. Before sample 0, and behind its end, it is zero.
class SharedSignal {
 public:
  /// Zeros. `lag`: how many samples before sample 0 may be read.
  SharedSignal(int samples, int lag);

  /// An impulse at sample 0, and a step.
  static SharedSignal impulse(int samples, int lag);
  static SharedSignal step(int samples, int lag);

  int samples() const { return samples_; }

  /// The address of sample 0 of the signal delayed by `lag`. Readable up to kPadding samples behind
  /// the signal's end.
  const double* delayed(int lag) const { return values_.data() + lag_ - lag; }
  double at(int t) const {
    return t >= 0 && t < samples_ ? values_[static_cast<std::size_t>(lag_ + t)] : 0;
  }

  /// This signal filtered by 1/P or by P, monic without the leading 1.
  SharedSignal dividedBy(const Eigen::VectorXd& p) const;
  SharedSignal times(const Eigen::VectorXd& p) const;

  static constexpr int kPadding = 64;

 private:
  int samples_, lag_;
  std::vector<double> values_;
};

/// The inner products over the first samples of two shared signals, both at all delays from 0 on:
/// sum_t f_(t-i) g_(t-j).
class LaggedProducts {
 public:
  /// The signals must outlive this object.
  LaggedProducts(const SharedSignal& f, int f_lags, const SharedSignal& g, int g_lags);

  /// Their values over the samples before `end`, which must not decrease from call to call.
  Eigen::MatrixXd until(int end);

 private:
  const SharedSignal* f_;
  const SharedSignal* g_;
  int end_ = 0;
  Eigen::VectorXd last_column_, last_row_;
};

/// Number of samples after which the response of 1/(P1 P2 ...) to an impulse has vanished within
/// rounding; at most `longest`.
int decayOf(const std::vector<Eigen::VectorXd>& denominators, int longest);

}  // namespace uncertainty_identification
