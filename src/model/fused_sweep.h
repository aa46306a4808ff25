#pragma once

#include <cstddef>
#include <cstring>

#include "uncertainty_identification/model/block.h"

// All functions on vectors are inlined, so vectors are never passed in calls and the warning about
// their ABI does not apply.
#pragma GCC diagnostic ignored "-Wpsabi"

#define UI_INLINE inline __attribute__((always_inline))
#define UI_UNROLL _Pragma("GCC unroll 8")

/// The loop of fused_at_rest.cpp, as a template over the vector type.
namespace uncertainty_identification {

/// Polynomials padded with zeros to a common order, and the block's samples.
template <int kOrder, int kRegressors>
struct FusedBlock {
  double b[kOrder], a[kOrder], c[kOrder], d[kOrder];
  double T[kRegressors + 1][kRegressors + 1];  ///< [lag][regressor]
  int delay, samples, lanes;
  int full;  ///< up to this sample every lane in use has data
  const double *u, *y, *weight;
};

/// The sums over all samples. Derivatives are indexed by kind of coefficient (b, a, c, d) times
/// kOrder plus lag. The sign of the kind (kFusedSigns) and the factor 2 on the diagonal have to be
/// applied afterwards.
template <int kOrder, int kRegressors>
struct FusedSums {
  static constexpr int kPairs = (kRegressors + 1) * (kRegressors + 2) / 2;
  Lanes gram[kPairs];                     ///< upper triangle of [Phi e]'[Phi e], row by row
  Lanes derivatives[4 * kOrder][kPairs];  ///< of `gram`
};

/// The sign to apply to the derivatives of each kind.
constexpr double kFusedSigns[4] = {1, -1, -1, 1};

/// Past values of a signal, newest first.
template <typename Vector, int kDepth>
struct FusedHistory {
  Vector value[kDepth] = {};

  UI_INLINE void push(const Vector& newest) {
    UI_UNROLL for (int k = kDepth - 1; k > 0; --k) value[k] = value[k - 1];
    value[0] = newest;
  }

  /// in - sum_k p_k value_(k-1): filters by 1/P if the result is then pushed.
  template <int kOrder>
  UI_INLINE Vector minus(const Vector& in, const double (&p)[kOrder]) const {
    Vector out = in;
    UI_UNROLL for (int k = 0; k < kOrder; ++k) out -= p[k] * value[k];
    return out;
  }

  /// in + sum_k p_k value_(k-1): filters by P if `in` is then pushed.
  template <int kOrder>
  UI_INLINE Vector plus(const Vector& in, const double (&p)[kOrder]) const {
    Vector out = in;
    UI_UNROLL for (int k = 0; k < kOrder; ++k) out += p[k] * value[k];
    return out;
  }

  /// sum_l T_li value_(lag+l): regressor i if this is the history of the simulated output.
  template <int kTaps>
  UI_INLINE Vector image(int lag, int i, const double (&T)[kTaps][kTaps]) const {
    Vector sum = T[0][i] * value[lag];
    UI_UNROLL for (int l = 1; l < kTaps; ++l) sum += T[l][i] * value[lag + l];
    return sum;
  }
};

template <typename Vector>
UI_INLINE Vector loadLanes(const double* signal, int t, int lane) {
  Vector value;
  std::memcpy(&value, signal + static_cast<std::ptrdiff_t>(kLanes) * t + lane, sizeof(Vector));
  return value;
}

/// The running sums of [Phi e]'[Phi e] and its derivatives, in registers as far as there are
/// enough.
template <typename Vector, int kOrder, int kRegressors>
struct FusedAccumulator {
  static constexpr int kTaps = kRegressors + 1;
  static constexpr int kPairs = FusedSums<kOrder, kRegressors>::kPairs;
  Vector gram[kPairs] = {};
  Vector derivatives[4 * kOrder][kPairs] = {};

  UI_INLINE void addGram(const Vector* regressor, const Vector& e) {
    int pair = 0;
    UI_UNROLL for (int i = 0; i < kRegressors; ++i) {
      UI_UNROLL for (int j = i; j < kRegressors; ++j) gram[pair++] += regressor[i] * regressor[j];
      gram[pair++] += regressor[i] * e;
    }
    gram[pair] += e * e;
  }

  /// Adds the terms for one kind of coefficient. de/dcoefficient_k is de_(t-k) with the sign
  /// kResidualSign; dPhi/dcoefficient_k is computed from dg_(t-k) as the regressors are from g.
  template <int kKind, int kResidualSign, typename DResidual, typename DSimulation>
  UI_INLINE void addDerivatives(const DResidual& de, const DSimulation& dg,
                                const double (&T)[kTaps][kTaps], const Vector* regressor,
                                const Vector& e) {
    UI_UNROLL for (int k = 0; k < kOrder; ++k) {
      Vector* sums = derivatives[kKind * kOrder + k];
      const Vector change = kResidualSign > 0 ? de.value[k] : -de.value[k];
      Vector dphi[kTaps];  // the last one is unused (zero-length arrays are not allowed)
      UI_UNROLL for (int i = 0; i < kRegressors; ++i) dphi[i] = dg.image(k, i, T);
      int pair = 0;
      UI_UNROLL for (int i = 0; i < kRegressors; ++i) {
        sums[pair++] += dphi[i] * regressor[i];
        UI_UNROLL for (int j = i + 1; j < kRegressors; ++j) {
          sums[pair] += dphi[i] * regressor[j];
          sums[pair++] += regressor[i] * dphi[j];
        }
        sums[pair] += dphi[i] * e;
        sums[pair++] += regressor[i] * change;
      }
      sums[pair] += e * change;
    }
  }

  UI_INLINE void store(int lane, FusedSums<kOrder, kRegressors>* sums) const {
    for (int pair = 0; pair < kPairs; ++pair) {
      std::memcpy(sums->gram[pair].data() + lane, &gram[pair], sizeof(Vector));
      for (int k = 0; k < 4 * kOrder; ++k) {
        std::memcpy(sums->derivatives[k][pair].data() + lane, &derivatives[k][pair],
                    sizeof(Vector));
      }
    }
  }
};

/// Sweeps over the samples of the lanes from `lane` on. All signals are rational filters of u and
/// y. Given u/(A C) and y/C, the numerators are FIR filters:
///   x/C = B u/(A C), (D/C) u/A, g = (D/C) x, w/C = (y - x)/C, e = D w/C.
template <typename Vector, bool kDerivatives, int kOrder, int kRegressors>
UI_INLINE void fusedSweep(const FusedBlock<kOrder, kRegressors>& in, int lane,
                          FusedSums<kOrder, kRegressors>* sums) {
  constexpr int kPrefetch = 16 * kLanes;  // [values] distance of memory prefetches
  constexpr int kDepth = kOrder + kRegressors;
  FusedAccumulator<Vector, kOrder, kRegressors> accumulator;
  FusedHistory<Vector, kOrder> u_a, u_ac, y_c, w_c, e_c;
  FusedHistory<Vector, kDepth> dc_u_a, x_c, g_a, g_c;
  FusedHistory<Vector, kRegressors + 1> g;
  for (int t = 0; t < in.samples; ++t) {
    __builtin_prefetch(in.u + static_cast<std::ptrdiff_t>(kLanes) * t + kPrefetch);
    __builtin_prefetch(in.y + static_cast<std::ptrdiff_t>(kLanes) * t + kPrefetch);
    const Vector u = t >= in.delay ? loadLanes<Vector>(in.u, t - in.delay, lane) : Vector{};
    u_a.push(u_a.minus(u, in.a));
    const Vector u_ac_now = u_ac.minus(u_a.value[0], in.c);
    dc_u_a.push(u_ac.plus(u_ac_now, in.d));
    u_ac.push(u_ac_now);
    Vector x_c_now = in.b[0] * u_ac.value[0];
    UI_UNROLL for (int k = 1; k < kOrder; ++k) x_c_now += in.b[k] * u_ac.value[k];
    g.push(x_c.plus(x_c_now, in.d));
    y_c.push(y_c.minus(loadLanes<Vector>(in.y, t, lane), in.c));
    const Vector w_c_now = y_c.value[0] - x_c_now;
    const Vector e_now = w_c.plus(w_c_now, in.d);

    Vector e = e_now, regressor[kRegressors + 1];
    UI_UNROLL for (int i = 0; i < kRegressors; ++i) regressor[i] = g.image(0, i, in.T);
    if (t >= in.full) {  // some experiment of the block has ended
      const Vector weight = loadLanes<Vector>(in.weight, t, lane);
      e *= weight;
      UI_UNROLL for (int i = 0; i < kRegressors; ++i) regressor[i] *= weight;
    }
    accumulator.addGram(regressor, e);
    if (kDerivatives) {  // derivatives to a, c and d need past values only: add them before pushing
      accumulator.template addDerivatives<0, -1>(dc_u_a, dc_u_a, in.T, regressor, e);
      accumulator.template addDerivatives<1, -1>(g_a, g_a, in.T, regressor, e);
      accumulator.template addDerivatives<2, 1>(e_c, g_c, in.T, regressor, e);
      accumulator.template addDerivatives<3, 1>(w_c, x_c, in.T, regressor, e);
      g_a.push(g_a.minus(g.value[0], in.a));
      e_c.push(e_c.minus(e_now, in.c));
      g_c.push(g_c.minus(g.value[0], in.c));
    }
    x_c.push(x_c_now);
    w_c.push(w_c_now);
  }
  accumulator.store(lane, sums);
}

}  // namespace uncertainty_identification
