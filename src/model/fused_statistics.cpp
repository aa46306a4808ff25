#include "fused_statistics.h"

#include <algorithm>
#include <array>

#include "pack.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Polynomials padded with zeros to a common order, and the block's samples.
template <int kOrder, int kRegressors>
struct Input {
  double b[kOrder], a[kOrder], c[kOrder], d[kOrder];
  double T[kRegressors + 1][kRegressors + 1];  ///< [lag][regressor]
  int delay, samples, full;                    ///< all lanes are in use up to sample `full`
  const Pack *u, *y, *weight;
};

/// Sums over the samples. The derivatives' index is coefficient kind (b, a, c, d) times order plus lag.
template <int kOrder, int kRegressors>
struct Sums {
  static constexpr int kPairs = (kRegressors + 1) * (kRegressors + 2) / 2;
  Pack gram[kPairs];                  ///< upper triangle of [Phi e]'[Phi e], row by row
  Pack derivatives[4 * kOrder][kPairs];  ///< of d[Phi e]'[Phi e] symmetrised
};

/// The newest value first; kDepth past values.
template <int kDepth>
struct History {
  Pack value[kDepth] = {};

  inline __attribute__((always_inline)) void push(Pack newest) {
#pragma GCC unroll 8
    for (int k = kDepth - 1; k > 0; --k) value[k] = value[k - 1];
    value[0] = newest;
  }

  /// in - sum_k p_k value_(k-1): one step of 1/P when the result is pushed.
  inline __attribute__((always_inline)) Pack minus(Pack in, const double* p) const {
#pragma GCC unroll 8
    for (int k = 0; k < kDepth; ++k) in -= p[k] * value[k];
    return in;
  }

  /// in + sum_k p_k value_(k-1): one step of P before `in` is pushed.
  inline __attribute__((always_inline)) Pack plus(Pack in, const double* p) const {
#pragma GCC unroll 8
    for (int k = 0; k < kDepth; ++k) in += p[k] * value[k];
    return in;
  }
};

/// One kind of coefficient: de/dcoefficient_k = sign_e e_(t-k), dPhi_i/dcoefficient_k = sign_phi phi_i(t-k).
template <int kOrder, int kRegressors>
struct Sensitivity {
  History<kOrder> e;
  History<kRegressors + 1> g;               ///< what phi is the FIR image of
  History<kOrder> phi[kRegressors + 1];     ///< the last one is unused (zero-length arrays are not allowed)

  template <typename T>
  inline __attribute__((always_inline)) void push(Pack of_e, Pack of_g, const T& basis) {
    e.push(of_e);
    g.push(of_g);
#pragma GCC unroll 8
    for (int i = 0; i < kRegressors; ++i) {
      Pack image = basis[0][i] * g.value[0];
#pragma GCC unroll 8
      for (int l = 1; l <= kRegressors; ++l) image += basis[l][i] * g.value[l];
      phi[i].push(image);
    }
  }
};

template <int kOrder, int kRegressors>
inline __attribute__((always_inline)) void accumulate(const Sensitivity<kOrder, kRegressors>& s, double sign_e,
                                                      double sign_phi, const Pack* regressor, Pack e,
                                                      Pack (*sums)[Sums<kOrder, kRegressors>::kPairs]) {
#pragma GCC unroll 8
  for (int k = 0; k < kOrder; ++k) {
    const Pack de = sign_e * s.e.value[k];
    int pair = 0;
#pragma GCC unroll 8
    for (int i = 0; i < kRegressors; ++i) {
      const Pack dphi = sign_phi * s.phi[i].value[k];
#pragma GCC unroll 8
      for (int j = i; j < kRegressors; ++j) {
        sums[k][pair++] += dphi * regressor[j] + regressor[i] * (sign_phi * s.phi[j].value[k]);
      }
      sums[k][pair++] += dphi * e + regressor[i] * de;
    }
    sums[k][pair] += 2.0 * (e * de);
  }
}

/// The sweep. Everything is a rational filter of u and y; with u/(A C) and y/C at hand the numerators are FIR:
///   x/C = B u/(A C), (D/C) u/A, g = (D/C) x, w/C = (y - x)/C, e = D w/C.
template <int kOrder, int kRegressors, bool kDerivatives>
inline __attribute__((always_inline)) void sweep(const Input<kOrder, kRegressors>& in,
                                                 Sums<kOrder, kRegressors>* result) {
  Sums<kOrder, kRegressors> sums = {};
  History<kOrder> u_a, u_ac, x_c, y_c, w_c, g_a, e_c, g_c;
  History<kRegressors + 1> g_past;
  Sensitivity<kOrder, kRegressors> to_b, to_a, to_c, to_d;
  for (int t = 0; t < in.samples; ++t) {
    const Pack u = t >= in.delay ? in.u[t - in.delay] : Pack{};
    // d's filters act on the past of x/C and w/C: read the sensitivities before pushing the present
    if (kDerivatives) {
      to_a.push(g_a.value[0], g_a.value[0], in.T);
      to_c.push(e_c.value[0], g_c.value[0], in.T);
      to_d.push(w_c.value[0], x_c.value[0], in.T);
    }
    u_a.push(u_a.minus(u, in.a));
    const Pack u_ac_now = u_ac.minus(u_a.value[0], in.c);
    const Pack dc_u_a = u_ac.plus(u_ac_now, in.d);
    u_ac.push(u_ac_now);
    Pack x_c_now = in.b[0] * u_ac.value[0];
#pragma GCC unroll 8
    for (int k = 1; k < kOrder; ++k) x_c_now += in.b[k] * u_ac.value[k];
    Pack g = x_c.plus(x_c_now, in.d);
    x_c.push(x_c_now);
    y_c.push(y_c.minus(in.y[t], in.c));
    const Pack w_c_now = y_c.value[0] - x_c_now;
    Pack e = w_c.plus(w_c_now, in.d);
    w_c.push(w_c_now);
    if (kDerivatives) {
      to_b.push(dc_u_a, dc_u_a, in.T);
      g_a.push(g_a.minus(g, in.a));
      e_c.push(e_c.minus(e, in.c));
      g_c.push(g_c.minus(g, in.c));
    }
    g_past.push(g);
    Pack regressor[kRegressors + 1];
#pragma GCC unroll 8
    for (int i = 0; i < kRegressors; ++i) {
      regressor[i] = in.T[0][i] * g_past.value[0];
#pragma GCC unroll 8
      for (int l = 1; l <= kRegressors; ++l) regressor[i] += in.T[l][i] * g_past.value[l];
    }
    if (t >= in.full) {  // some experiment of the block has ended
      e *= in.weight[t];
#pragma GCC unroll 8
      for (int i = 0; i < kRegressors; ++i) regressor[i] *= in.weight[t];
    }
    int pair = 0;
#pragma GCC unroll 8
    for (int i = 0; i < kRegressors; ++i) {
#pragma GCC unroll 8
      for (int j = i; j < kRegressors; ++j) sums.gram[pair++] += regressor[i] * regressor[j];
      sums.gram[pair++] += regressor[i] * e;
    }
    sums.gram[pair] += e * e;
    if (kDerivatives) {
      accumulate<kOrder, kRegressors>(to_b, -1, 1, regressor, e, sums.derivatives);
      accumulate<kOrder, kRegressors>(to_a, 1, -1, regressor, e, sums.derivatives + kOrder);
      accumulate<kOrder, kRegressors>(to_c, -1, -1, regressor, e, sums.derivatives + 2 * kOrder);
      accumulate<kOrder, kRegressors>(to_d, 1, 1, regressor, e, sums.derivatives + 3 * kOrder);
    }
  }
  *result = sums;
}

/// Copies the upper triangle `pairs` of one lane to a full symmetric matrix.
template <int kRegressors>
void expand(const Pack* pairs, int lane, Statistics::Gram to) {
  int pair = 0;
  for (int i = 0; i <= kRegressors; ++i) {
    for (int j = i; j <= kRegressors; ++j) {
      to(i, j) = to(j, i) = pairs[pair++][lane];
    }
  }
}

template <int kOrder, int kRegressors>
Input<kOrder, kRegressors> inputOf(const Block& block, const Polynomials& p, const MatrixXd& T) {
  Input<kOrder, kRegressors> in = {};
  std::copy_n(p.b.data(), p.b.size(), in.b);
  std::copy_n(p.a.data(), p.a.size(), in.a);
  std::copy_n(p.c.data(), p.c.size(), in.c);
  std::copy_n(p.d.data(), p.d.size(), in.d);
  for (Index l = 0; l < T.rows(); ++l) {
    for (Index i = 0; i < T.cols(); ++i) in.T[l][i] = T(l, i);
  }
  in.delay = p.delay;
  in.samples = block.samples;
  in.full = block.lengths[static_cast<std::size_t>(block.lanes) - 1];
  in.u = packs(block.u);
  in.y = packs(block.y);
  in.weight = packs(block.weight);
  return in;
}

template <int kOrder, int kRegressors>
void writeLane(const Sums<kOrder, kRegressors>& sums, const Block& block, const Polynomials& p,
               const MatrixXd& jacobian, int lane, Statistics* statistics) {
  const int r = block.index[static_cast<std::size_t>(lane)];
  expand<kRegressors>(sums.gram, lane, statistics->gram(r));
  statistics->samples()[r] = block.lengths[static_cast<std::size_t>(lane)];
  statistics->logJacobian()[r] = 0;
  if (jacobian.cols() == 0) return;
  statistics->logJacobianDerivatives().col(r).setZero();
  MatrixXd of_coefficient(kRegressors + 1, kRegressors + 1);
  for (Index j = 0; j < jacobian.cols(); ++j) statistics->gramDerivative(r, static_cast<int>(j)).setZero();
  const std::array<Index, 4> sizes{p.b.size(), p.a.size(), p.c.size(), p.d.size()};
  Index row = 0;
  for (int kind = 0; kind < 4; ++kind) {
    for (Index k = 0; k < sizes[static_cast<std::size_t>(kind)]; ++k, ++row) {
      expand<kRegressors>(sums.derivatives[kind * kOrder + k], lane,
                          {of_coefficient.data(), kRegressors + 1, kRegressors + 1});
      for (Index j = 0; j < jacobian.cols(); ++j) {
        if (jacobian(row, j) == 0) continue;
        statistics->gramDerivative(r, static_cast<int>(j)) += jacobian(row, j) * of_coefficient;
      }
    }
  }
}

// clang-format off
#define UI_SWEEP(order, regressors)                                                                              \
  UI_VECTOR_CLONES void sweep_##order##_##regressors(const Input<order, regressors>& in,                         \
                                                     Sums<order, regressors>* sums) {                            \
    sweep<order, regressors, true>(in, sums);                                                                    \
  }                                                                                                              \
  UI_VECTOR_CLONES void value_##order##_##regressors(const Input<order, regressors>& in,                         \
                                                     Sums<order, regressors>* sums) {                            \
    sweep<order, regressors, false>(in, sums);                                                                   \
  }                                                                                                              \
  void run_##order##_##regressors(const Block& block, const Polynomials& p, const MatrixXd& T,                   \
                                  const MatrixXd& jacobian, Statistics* statistics) {                            \
    Sums<order, regressors> sums;                                                                                \
    const auto in = inputOf<order, regressors>(block, p, T);                                                     \
    (jacobian.cols() > 0 ? sweep_##order##_##regressors : value_##order##_##regressors)(in, &sums);              \
    for (int lane = 0; lane < block.lanes; ++lane) {                                                             \
      writeLane<order, regressors>(sums, block, p, jacobian, lane, statistics);                                  \
    }                                                                                                            \
  }
// clang-format on

UI_SWEEP(1, 0)
UI_SWEEP(1, 1)
UI_SWEEP(1, 2)
UI_SWEEP(2, 0)
UI_SWEEP(2, 1)
UI_SWEEP(2, 2)
UI_SWEEP(4, 0)
UI_SWEEP(4, 1)
UI_SWEEP(4, 2)

using Run = void (*)(const Block&, const Polynomials&, const MatrixXd&, const MatrixXd&, Statistics*);

constexpr Run kRuns[3][3] = {{run_1_0, run_1_1, run_1_2}, {run_2_0, run_2_1, run_2_2}, {run_4_0, run_4_1, run_4_2}};

}  // namespace

bool fusedBoxJenkins(const Block& block, const Polynomials& p, const MatrixXd& T, const MatrixXd& jacobian,
                     Statistics* statistics) {
  const Index order = std::max({p.b.size(), p.a.size(), p.c.size(), p.d.size()});
  const Index regressors = T.cols();
  if (order > 4 || regressors > 2 || T.rows() > regressors + 1) return false;
  const int row = order <= 1 ? 0 : (order == 2 ? 1 : 2);
  kRuns[row][regressors](block, p, T, jacobian, statistics);
  return true;
}

}  // namespace uncertainty_identification
