#include "uncertainty_identification/model/filter.h"

#include <algorithm>

#include "pack.h"

namespace uncertainty_identification {
namespace {

UI_VECTOR_CLONES
void recursion(const double* d, int order, int samples, Pack* x) {
  for (int t = 0; t < samples; ++t) {
    Pack value = x[t];
    for (int k = 1; k <= std::min(order, t); ++k) value -= d[k - 1] * x[t - k];
    x[t] = value;
  }
}

UI_VECTOR_CLONES
void accumulate(double factor, int delay, int samples, const Pack* in, Pack* out) {
  for (int t = delay; t < samples; ++t) out[t] += factor * in[t - delay];
}

UI_VECTOR_CLONES
void product(int samples, const Pack* left, const Pack* right, Pack* sum) {
  Pack even = {}, odd = {};  // two chains hide the latency of the addition
  int t = 0;
  for (; t + 1 < samples; t += 2) {
    even += left[t] * right[t];
    odd += left[t + 1] * right[t + 1];
  }
  if (t < samples) even += left[t] * right[t];
  *sum = even + odd;
}

}  // namespace

void filter(const Eigen::VectorXd& numerator, const Eigen::VectorXd& monic_denominator, int delay, const Signals& in,
            Signals* out) {
  const int samples = static_cast<int>(in.cols());
  out->setZero(kLanes, samples);
  for (Eigen::Index k = 0; k < numerator.size(); ++k) {
    addShifted(numerator[k], delay + static_cast<int>(k), in, out);
  }
  if (monic_denominator.size() > 0) {
    recursion(monic_denominator.data(), static_cast<int>(monic_denominator.size()), samples, packs(out));
  }
}

void shift(int delay, const Signals& in, Signals* out) {
  const Eigen::Index samples = in.cols(), lag = std::min<Eigen::Index>(delay, samples);
  out->resize(kLanes, samples);
  out->leftCols(lag).setZero();
  out->rightCols(samples - lag) = in.leftCols(samples - lag);
}

void addShifted(double factor, int delay, const Signals& in, Signals* out) {
  accumulate(factor, delay, static_cast<int>(in.cols()), packs(in), packs(out));
}

Lanes dot(const Signals& left, const Signals& right) {
  Lanes sum;
  product(static_cast<int>(left.cols()), packs(left), packs(right), reinterpret_cast<Pack*>(sum.data()));
  return sum;
}

}  // namespace uncertainty_identification
