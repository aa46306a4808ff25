#include "model/shared_signal.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

SharedSignal::SharedSignal(int samples, int lag)
    : samples_(samples),
      lag_(lag),
      values_(static_cast<std::size_t>(2 * lag + samples + kPadding)) {}

SharedSignal SharedSignal::impulse(int samples, int lag) {
  SharedSignal made(samples, lag);
  if (samples > 0) made.values_[static_cast<std::size_t>(lag)] = 1;
  return made;
}

SharedSignal SharedSignal::step(int samples, int lag) {
  SharedSignal made(samples, lag);
  std::fill_n(made.values_.begin() + lag, samples, 1.0);
  return made;
}

SharedSignal SharedSignal::dividedBy(const VectorXd& p) const {
  SharedSignal out = *this;
  double* value = out.values_.data() + lag_;
  for (int t = 0; t < samples_; ++t, ++value) {
    for (Index k = p.size(); k > 0; --k) *value -= p[k - 1] * value[-k];
  }
  return out;
}

SharedSignal SharedSignal::times(const VectorXd& p) const {
  SharedSignal out = *this;
  const double* in = delayed(0);
  for (int t = 0; t < samples_; ++t) {
    for (Index k = 1; k <= p.size(); ++k)
      out.values_[static_cast<std::size_t>(lag_ + t)] += p[k - 1] * in[t - k];
  }
  return out;
}

LaggedProducts::LaggedProducts(const SharedSignal& f, int f_lags, const SharedSignal& g, int g_lags)
    : f_(&f), g_(&g), last_column_(VectorXd::Zero(f_lags)), last_row_(VectorXd::Zero(g_lags)) {}

MatrixXd LaggedProducts::until(int end) {
  const auto dot = [&](int i, int j) {  // of the samples since the last call
    const int last = std::min({end, f_->samples() + i, g_->samples() + j});
    const Index count = std::max(0, last - end_);
    return Eigen::Map<const VectorXd>(f_->delayed(i) + end_, count)
        .dot(Eigen::Map<const VectorXd>(g_->delayed(j) + end_, count));
  };
  const auto rows = static_cast<int>(last_column_.size()),
             columns = static_cast<int>(last_row_.size());
  for (int i = 0; i < rows; ++i) last_column_[i] += dot(i, columns - 1);
  for (int j = 0; j < columns - 1; ++j) last_row_[j] += dot(rows - 1, j);
  end_ = end;
  MatrixXd all(rows, columns);
  all.row(rows - 1) = last_row_.transpose();
  all.col(columns - 1) = last_column_;
  for (int j = columns - 2; j >= 0; --j) {
    for (int i = rows - 2; i >= 0; --i)  // one sample less of delay: one more product
      all(i, j) = all(i + 1, j + 1) + f_->at(end - 1 - i) * g_->at(end - 1 - j);
  }
  return all;
}

int decayOf(const std::vector<VectorXd>& denominators, int longest) {
  // So small that no later value exceeds the precision of the sums, even if several slow poles make
  // the response grow again.
  constexpr double kForgotten = 1e-30, kVanished = 1e-17;
  std::size_t order = 0;
  for (const VectorXd& p : denominators) order += static_cast<std::size_t>(p.size());
  std::vector<std::vector<double>> responses(denominators.size());  // behind each factor
  double largest = 0;
  std::size_t small = 0;  // number of small values so far in a row
  int end = 0;
  for (int t = 0; t < longest && small <= order; ++t) {
    double value = t == 0 ? 1 : 0;
    for (std::size_t f = 0; f < denominators.size(); ++f) {
      const VectorXd& p = denominators[f];
      std::vector<double>& response = responses[f];
      const double* before = response.data() + t;
      for (Index k = 1; k <= std::min<Index>(p.size(), t); ++k) value -= p[k - 1] * before[-k];
      response.push_back(value);
    }
    largest = std::max(largest, std::abs(value));
    small = std::abs(value) < kForgotten * largest ? small + 1 : 0;
    if (std::abs(value) > kVanished * largest) end = t + 1;
  }
  return std::max(end, std::min(longest, 1));
}

}  // namespace uncertainty_identification
