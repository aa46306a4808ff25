#include "model/sweep_kernels.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "uncertainty_identification/model/block.h"

// All functions on vectors are inlined, so vectors are never passed in calls and the warning about
// their ABI does not apply.
#pragma GCC diagnostic ignored "-Wpsabi"

#define UI_INLINE inline __attribute__((always_inline))
#define UI_UNROLL _Pragma("GCC unroll 8")

namespace uncertainty_identification {
namespace {

// Vectors as wide as the registers of each vector unit. They read and write memory of any
// alignment.
typedef double Vector2 __attribute__((vector_size(16)));
typedef double Vector4 __attribute__((vector_size(32)));
typedef double Vector8 __attribute__((vector_size(64)));

template <typename Vector>
constexpr int kWidth = sizeof(Vector) / sizeof(double);

template <typename Vector>
UI_INLINE Vector load(const double* signal, int t) {
  Vector value;  // the memory may have any alignment
  std::memcpy(&value, signal + static_cast<std::ptrdiff_t>(kLanes) * t, sizeof(Vector));
  return value;
}

template <typename Vector>
UI_INLINE void store(const Vector& value, double* signal, int t) {
  std::memcpy(signal + static_cast<std::ptrdiff_t>(kLanes) * t, &value, sizeof(Vector));
}

/// Coefficients of a filter. Those of a small number known beforehand are copied, because the
/// compiler must assume that storing a sample may change the originals.
template <int kCount>
struct Coefficients {
  UI_INLINE Coefficients(const double* from, int /*count*/) {
    for (int k = 0; k < kCount; ++k) values[k] = from[k];
  }
  static constexpr int count() { return kCount; }
  UI_INLINE double operator[](int k) const { return values[k]; }
  double values[std::max(kCount, 1)];
};

constexpr int kAnyNumber = -1;

template <>
struct Coefficients<kAnyNumber> {
  UI_INLINE Coefficients(const double* from, int number) : values(from), size(number) {}
  int count() const { return size; }
  UI_INLINE double operator[](int k) const { return values[k]; }
  const double* values;
  int size;
};

/// Filters neighbouring vectors of one or two signals: a recursion waits for its own arithmetic,
/// which leaves time for others.
template <typename Vector, int kSignals, int kVectors, int kZeros, int kPoles>
UI_INLINE void filterVectors(const PieceFilter& by, const double* const* in, int lane, int samples,
                             double* const* out) {
  constexpr int kAll = kSignals * kVectors;
  const Coefficients<kZeros> numerator(by.numerator, by.zeros);
  const Coefficients<kPoles> denominator(by.denominator, by.poles);
  const int zeros = numerator.count(), poles = denominator.count();
  const double* from[kAll];
  double* to[kAll];
  Vector last[kAll];  // the newest output stays in a register
  UI_UNROLL for (int v = 0; v < kAll; ++v) {
    from[v] = in[v / kVectors] + lane + v % kVectors * kWidth<Vector>;
    to[v] = out[v / kVectors] + lane + v % kVectors * kWidth<Vector>;
    last[v] = load<Vector>(to[v], -1);
  }
  for (int t = 0; t < samples; ++t) {
    UI_UNROLL for (int v = 0; v < kAll; ++v) {
      Vector value = load<Vector>(from[v], t);
      if (zeros != 0) value *= numerator[0];
      UI_UNROLL for (int k = 1; k < zeros; ++k) value +=
          numerator[k] * load<Vector>(from[v], t - k);
      UI_UNROLL for (int k = poles; k > 1; --k) value -=
          denominator[k - 1] * load<Vector>(to[v], t - k);
      if (poles != 0) value -= denominator[0] * last[v];
      last[v] = value;
      store(value, to[v], t);
    }
  }
}

template <typename Vector, int kSignals, int kZeros, int kPoles>
UI_INLINE void filterLanes(const PieceFilter& by, const double* const* in, int samples, int lanes,
                           double* const* out) {
  constexpr int kStep = kWidth<Vector>;
  constexpr int kTogether = 2 * kStep <= kLanes ? 2 : 1;
  int lane = 0;
  for (; lane + (kTogether - 1) * kStep < lanes; lane += kTogether * kStep)
    filterVectors<Vector, kSignals, kTogether, kZeros, kPoles>(by, in, lane, samples, out);
  for (; lane < lanes; lane += kStep)
    filterVectors<Vector, kSignals, 1, kZeros, kPoles>(by, in, lane, samples, out);
}

template <typename Vector, int kZeros, int kPoles>
UI_INLINE void filterAs(const PieceFilter& by, const double* const* in, int signals, int samples,
                        int lanes, double* const* out) {
  int s = 0;
  for (; s + 1 < signals; s += 2)
    filterLanes<Vector, 2, kZeros, kPoles>(by, in + s, samples, lanes, out + s);
  if (s < signals) filterLanes<Vector, 1, kZeros, kPoles>(by, in + s, samples, lanes, out + s);
}

/// The sizes of models of first and second order have loops of their own.
template <typename Vector>
UI_INLINE void filterPiece(const PieceFilter& by, const double* const* in, int signals, int samples,
                           int lanes, double* const* out) {
  switch (by.zeros > 3 || by.poles > 2 ? -1 : by.zeros * 10 + by.poles) {
    case 1:
      return filterAs<Vector, 0, 1>(by, in, signals, samples, lanes, out);
    case 2:
      return filterAs<Vector, 0, 2>(by, in, signals, samples, lanes, out);
    case 11:
      return filterAs<Vector, 1, 1>(by, in, signals, samples, lanes, out);
    case 20:
      return filterAs<Vector, 2, 0>(by, in, signals, samples, lanes, out);
    case 21:
      return filterAs<Vector, 2, 1>(by, in, signals, samples, lanes, out);
    case 32:
      return filterAs<Vector, 3, 2>(by, in, signals, samples, lanes, out);
    default:
      return filterAs<Vector, kAnyNumber, kAnyNumber>(by, in, signals, samples, lanes, out);
  }
}

template <typename Vector>
UI_INLINE void subtractPiece(const double* left, const double* right, const double* constant,
                             int samples, int lanes, double* out) {
  for (int lane = 0; lane < lanes; lane += kWidth<Vector>) {
    const Vector same = load<Vector>(constant + lane, 0);
    for (int t = 0; t < samples; ++t)
      store(load<Vector>(left + lane, t) - load<Vector>(right + lane, t) - same, out + lane, t);
  }
}

template <typename Vector, bool kShared>
using Factor = std::conditional_t<kShared, double, Vector>;

template <typename Vector, bool kShared>
UI_INLINE Factor<Vector, kShared> loadFactor(const double* signal, int lane, int t) {
  if constexpr (kShared) {
    return signal[t];
  } else {
    return load<Vector>(signal + lane, t);
  }
}

/// The products of kLefts by kRights signals in one vector of lanes, their sums in registers.
template <typename Vector, bool kShared, int kLefts, int kRights>
UI_INLINE void addTile(const double* const* left, const double* const* right, int rights,
                       int samples, int lane, double* sums) {
  Vector sum[kLefts][kRights];
  UI_UNROLL for (int i = 0; i < kLefts; ++i) {
    UI_UNROLL for (int j = 0; j < kRights; ++j) sum[i][j] =
        load<Vector>(sums + lane, i * rights + j);
  }
  for (int t = 0; t < samples; ++t) {
    Vector factor[kRights];
    UI_UNROLL for (int j = 0; j < kRights; ++j) factor[j] = load<Vector>(right[j] + lane, t);
    UI_UNROLL for (int i = 0; i < kLefts; ++i) {
      const Factor<Vector, kShared> other = loadFactor<Vector, kShared>(left[i], lane, t);
      UI_UNROLL for (int j = 0; j < kRights; ++j) sum[i][j] += other * factor[j];
    }
  }
  UI_UNROLL for (int i = 0; i < kLefts; ++i) {
    UI_UNROLL for (int j = 0; j < kRights; ++j) store(sum[i][j], sums + lane, i * rights + j);
  }
}

template <typename Vector, bool kShared, int kRights>
UI_INLINE void addColumns(const double* const* left, int lefts, const double* const* right,
                          int rights, int samples, int lane, double* sums) {
  const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(rights) * kLanes;
  int i = 0;
  for (; i + 3 < lefts; i += 4)
    addTile<Vector, kShared, 4, kRights>(left + i, right, rights, samples, lane, sums + i * row);
  for (; i < lefts; ++i)
    addTile<Vector, kShared, 1, kRights>(left + i, right, rights, samples, lane, sums + i * row);
}

template <typename Vector, bool kShared>
UI_INLINE void addProducts(const double* const* left, int lefts, const double* const* right,
                           int rights, int samples, int lanes, double* sums) {
  for (int lane = 0; lane < lanes; lane += kWidth<Vector>) {
    int j = 0;
    for (; j + 1 < rights; j += 2) {
      addColumns<Vector, kShared, 2>(left, lefts, right + j, rights, samples, lane,
                                     sums + j * kLanes);
    }
    if (j < rights) {
      addColumns<Vector, kShared, 1>(left, lefts, right + j, rights, samples, lane,
                                     sums + j * kLanes);
    }
  }
}

// The loops for one vector unit, which is named by the features that the compiler may use. An
// attribute cannot stand in parentheses.
// NOLINTBEGIN(bugprone-macro-parentheses)
#define UI_SWEEP_KERNELS(name, Vector, target)                                                    \
  struct name {                                                                                   \
    target static void filter(const PieceFilter& by, const double* const* in, int signals,        \
                              int samples, int lanes, double* const* out) {                       \
      filterPiece<Vector>(by, in, signals, samples, lanes, out);                                  \
    }                                                                                             \
    target static void subtract(const double* left, const double* right, const double* constant,  \
                                int samples, int lanes, double* out) {                            \
      subtractPiece<Vector>(left, right, constant, samples, lanes, out);                          \
    }                                                                                             \
    target static void products(const double* const* left, int lefts, const double* const* right, \
                                int rights, int samples, int lanes, double* sums) {               \
      addProducts<Vector, false>(left, lefts, right, rights, samples, lanes, sums);               \
    }                                                                                             \
    target static void sharedProducts(const double* const* left, int lefts,                       \
                                      const double* const* right, int rights, int samples,        \
                                      int lanes, double* sums) {                                  \
      addProducts<Vector, true>(left, lefts, right, rights, samples, lanes, sums);                \
    }                                                                                             \
    static constexpr SweepKernels kernels = {filter, subtract, products, sharedProducts};         \
  };
// NOLINTEND(bugprone-macro-parentheses)

UI_SWEEP_KERNELS(Baseline, Vector2, )
#if defined(__x86_64__)
UI_SWEEP_KERNELS(Avx2, Vector4, __attribute__((target("avx2,fma"))))
UI_SWEEP_KERNELS(Avx512, Vector8, __attribute__((target("avx512f"))))
#endif

const SweepKernels& chosen() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return Avx512::kernels;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return Avx2::kernels;
#endif
  return Baseline::kernels;
}

}  // namespace

const SweepKernels& sweepKernels() {
  static const SweepKernels& kernels = chosen();
  return kernels;
}

}  // namespace uncertainty_identification
