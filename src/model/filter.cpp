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

struct Term {
  const Pack* signal;
  const Pack* factor;
  int delay;
};

UI_VECTOR_CLONES
void filterTerms(const Term* terms, int count, const Pack* a, int order, int samples, Pack* x) {
  for (int t = 0; t < samples; ++t) {
    Pack value = x[t];
    for (int i = 0; i < count; ++i) {
      if (t >= terms[i].delay) value += *terms[i].factor * terms[i].signal[t - terms[i].delay];
    }
    for (int k = 1; k <= std::min(order, t); ++k) value -= a[k - 1] * x[t - k];
    x[t] = value;
  }
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

void filterSum(const std::vector<DelayedSignal>& terms, const std::vector<Lanes>& a, Signals* x) {
  checkpoint();
  std::vector<Term> all;
  all.reserve(terms.size());
  for (const DelayedSignal& term : terms)
    all.push_back(
        {packs(*term.signal), reinterpret_cast<const Pack*>(term.factor.data()), term.delay});
  filterTerms(all.data(), static_cast<int>(all.size()), reinterpret_cast<const Pack*>(a.data()),
              static_cast<int>(a.size()), static_cast<int>(x->cols()), packs(x));
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

namespace {

/// The signals that are not zero, the longest first.
struct Nonzero {
  explicit Nonzero(const std::vector<const Signals*>& all) {
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k] != nullptr) place.push_back(k);
    }
    std::stable_sort(place.begin(), place.end(), [&all](std::size_t one, std::size_t other) {
      return all[one]->cols() > all[other]->cols();
    });
    for (const std::size_t k : place) {
      data.push_back(all[k]->data());
      lengths.push_back(static_cast<int>(all[k]->cols()));
    }
  }
  std::size_t count() const { return data.size(); }

  std::vector<std::size_t> place;  ///< in the list
  std::vector<const double*> data;
  std::vector<int> lengths;
};

/// sums[j] += left'right_j over the samples [first, last) that both have, for j >= from.
void addProducts(const double* left, const Nonzero& right, std::size_t from, int first, int last,
                 Lanes* sums) {
  std::size_t whole = from;
  while (whole < right.count() && right.lengths[whole] >= last) ++whole;
  accumulateProducts(left, right.data.data() + from, static_cast<int>(whole - from), first, last,
                     reinterpret_cast<Pack*>(sums + from));
  for (std::size_t j = whole; j < right.count() && right.lengths[j] > first; ++j)
    accumulateProducts(left, right.data.data() + j, 1, first, right.lengths[j],
                       reinterpret_cast<Pack*>(sums + j));
}

}  // namespace

std::vector<Lanes> innerProducts(const std::vector<const Signals*>& left,
                                 const std::vector<const Signals*>& right) {
  constexpr int kPiece =
      64;  // samples per piece: pieces of several dozen signals fit the second-level cache
  const Nonzero l(left), r(right);
  const bool symmetric = left == right;  // half of the products will do
  std::vector<Lanes> dense(l.count() * r.count(), Lanes::Zero());
  const int samples = l.count() > 0 ? l.lengths.front() : 0;
  for (int first = 0; first < samples; first += kPiece) {
    checkpoint();
    for (std::size_t i = 0; i < l.count() && l.lengths[i] > first; ++i)
      addProducts(l.data[i], r, symmetric ? i : 0, first, std::min(first + kPiece, l.lengths[i]),
                  dense.data() + i * r.count());
  }
  std::vector<Lanes> sums(left.size() * right.size(), Lanes::Zero());
  for (std::size_t i = 0; i < l.count(); ++i) {
    for (std::size_t j = 0; j < r.count(); ++j)
      sums[l.place[i] * right.size() + r.place[j]] =
          dense[symmetric && j < i ? j * r.count() + i : i * r.count() + j];
  }
  return sums;
}

}  // namespace uncertainty_identification
