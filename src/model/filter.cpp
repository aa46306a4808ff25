#include "model/filter.h"

#include <algorithm>

#include "math/interruption.h"
#include "model/pack.h"

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

/// sums[j] += left'right_j over the samples [first, last). Handles four signals right_j at a time,
/// so that `left` is loaded once for all four.
UI_VECTOR_CLONES
void accumulateProducts(const double* left, const double* const* right, int count, int first,
                        int last, Pack* sums) {
  const Pack* l = reinterpret_cast<const Pack*>(left);
  int j = 0;
  for (; j + 3 < count; j += 4) {
    const Pack *r0 = reinterpret_cast<const Pack*>(right[j]),
               *r1 = reinterpret_cast<const Pack*>(right[j + 1]);
    const Pack *r2 = reinterpret_cast<const Pack*>(right[j + 2]),
               *r3 = reinterpret_cast<const Pack*>(right[j + 3]);
    Pack s0 = sums[j], s1 = sums[j + 1], s2 = sums[j + 2], s3 = sums[j + 3];
    for (int t = first; t < last; ++t) {
      s0 += l[t] * r0[t];
      s1 += l[t] * r1[t];
      s2 += l[t] * r2[t];
      s3 += l[t] * r3[t];
    }
    sums[j] = s0;
    sums[j + 1] = s1;
    sums[j + 2] = s2;
    sums[j + 3] = s3;
  }
  for (; j < count; ++j) {
    const Pack* r = reinterpret_cast<const Pack*>(right[j]);
    Pack sum = sums[j];
    for (int t = first; t < last; ++t) sum += l[t] * r[t];
    sums[j] = sum;
  }
}

}  // namespace

void filter(const Eigen::VectorXd& numerator, const Eigen::VectorXd& monic_denominator, int delay,
            const Signals& in, Signals* out) {
  checkpoint();
  const int samples = static_cast<int>(in.cols());
  out->setZero(kLanes, samples);
  for (Eigen::Index k = 0; k < numerator.size(); ++k) {
    addShifted(numerator[k], delay + static_cast<int>(k), in, out);
  }
  if (monic_denominator.size() > 0) {
    recursion(monic_denominator.data(), static_cast<int>(monic_denominator.size()), samples,
              packs(out));
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

std::vector<Lanes> innerProducts(const std::vector<const Signals*>& left,
                                 const std::vector<const Signals*>& right) {
  constexpr int kPiece =
      64;  // samples per piece: pieces of several dozen signals fit the second-level cache
  std::vector<const double*> rights;
  std::vector<std::size_t> place;
  Eigen::Index samples = 0;
  for (std::size_t j = 0; j < right.size(); ++j) {
    if (right[j] == nullptr) continue;
    rights.push_back(right[j]->data());
    place.push_back(j);
    samples = right[j]->cols();
  }
  const std::size_t count = rights.size();
  const bool symmetric = left == right && count == right.size();  // half of the products will do
  std::vector<Lanes> dense(left.size() * count, Lanes::Zero());
  for (Eigen::Index first = 0; first < samples; first += kPiece) {
    checkpoint();
    const auto last = static_cast<int>(std::min<Eigen::Index>(first + kPiece, samples));
    for (std::size_t i = 0; i < left.size(); ++i) {
      if (left[i] == nullptr) continue;
      const std::size_t from = symmetric ? i : 0;
      accumulateProducts(left[i]->data(), rights.data() + from, static_cast<int>(count - from),
                         static_cast<int>(first), last,
                         reinterpret_cast<Pack*>(dense.data() + i * count + from));
    }
  }
  std::vector<Lanes> sums(left.size() * right.size(), Lanes::Zero());
  for (std::size_t i = 0; i < left.size(); ++i) {
    for (std::size_t j = 0; j < count; ++j)
      sums[i * right.size() + place[j]] =
          symmetric && j < i ? dense[j * count + i] : dense[i * count + j];
  }
  return sums;
}

}  // namespace uncertainty_identification
