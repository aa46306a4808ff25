#include "model/fused_at_rest.h"

#include <algorithm>
#include <array>

#include "model/fused_sweep.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

typedef double Vector2 __attribute__((vector_size(2 * sizeof(double))));
typedef double Vector4 __attribute__((vector_size(4 * sizeof(double))));
typedef double Vector8 __attribute__((vector_size(8 * sizeof(double))));

template <typename Vector, bool kDerivatives, int kOrder, int kRegressors>
UI_INLINE void sweepAll(const FusedBlock<kOrder, kRegressors>& in,
                        FusedSums<kOrder, kRegressors>* sums) {
  constexpr int kWidth = sizeof(Vector) / sizeof(double);
  for (int lane = 0; lane < in.lanes; lane += kWidth) {
    fusedSweep<Vector, kDerivatives>(in, lane, sums);
  }
}

template <int kOrder, int kRegressors>
using Sweep = void (*)(const FusedBlock<kOrder, kRegressors>&, FusedSums<kOrder, kRegressors>*);

// One version per vector unit. The vectors of each are as wide as its registers: wider ones would
// be split into several registers, the sums would no longer fit into the registers, and the loop
// would be five times slower.
template <bool kDerivatives, int kOrder, int kRegressors>
void sweepBaseline(const FusedBlock<kOrder, kRegressors>& in,
                   FusedSums<kOrder, kRegressors>* sums) {
  sweepAll<Vector2, kDerivatives>(in, sums);
}

#if defined(__x86_64__)
template <bool kDerivatives, int kOrder, int kRegressors>
__attribute__((target("avx2,fma"))) void sweepAvx2(const FusedBlock<kOrder, kRegressors>& in,
                                                   FusedSums<kOrder, kRegressors>* sums) {
  sweepAll<Vector4, kDerivatives>(in, sums);
}

template <bool kDerivatives, int kOrder, int kRegressors>
__attribute__((target("avx512f"))) void sweepAvx512(const FusedBlock<kOrder, kRegressors>& in,
                                                    FusedSums<kOrder, kRegressors>* sums) {
  sweepAll<Vector8, kDerivatives>(in, sums);
}

/// The version for the processor that the program runs on.
template <bool kDerivatives, int kOrder, int kRegressors>
Sweep<kOrder, kRegressors> chooseSweep() {
  if (__builtin_cpu_supports("avx512f")) return sweepAvx512<kDerivatives, kOrder, kRegressors>;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    return sweepAvx2<kDerivatives, kOrder, kRegressors>;
  }
  return sweepBaseline<kDerivatives, kOrder, kRegressors>;
}
#else
template <bool kDerivatives, int kOrder, int kRegressors>
Sweep<kOrder, kRegressors> chooseSweep() {
  return sweepBaseline<kDerivatives, kOrder, kRegressors>;
}
#endif

template <int kOrder, int kRegressors>
FusedBlock<kOrder, kRegressors> inputOf(const Block& block, const Polynomials& p,
                                        const MatrixXd& T) {
  FusedBlock<kOrder, kRegressors> in = {};
  std::copy_n(p.b.data(), p.b.size(), in.b);
  std::copy_n(p.a.data(), p.a.size(), in.a);
  std::copy_n(p.c.data(), p.c.size(), in.c);
  std::copy_n(p.d.data(), p.d.size(), in.d);
  for (Index l = 0; l < T.rows(); ++l) {
    for (Index i = 0; i < T.cols(); ++i) in.T[l][i] = T(l, i);
  }
  in.delay = p.delay;
  in.samples = block.samples;
  in.lanes = block.lanes;
  in.full = block.lengths[static_cast<std::size_t>(block.lanes) - 1];
  in.u = block.u.data();
  in.y = block.y.data();
  in.weight = block.weight.data();
  return in;
}

/// Expands the upper triangles `pairs` of all lanes to full symmetric matrices. `matrix_of` gives
/// the destination for an experiment.
template <int kRegressors, typename MatrixOf>
void expand(const Lanes* pairs, const Block& block, const MatrixOf& matrix_of) {
  constexpr int kSize = kRegressors + 1;
  for (int lane = 0; lane < block.lanes; ++lane) {
    double* to = matrix_of(block.index[static_cast<std::size_t>(lane)]).data();
    int pair = 0;
    UI_UNROLL for (int i = 0; i < kSize; ++i) {
      UI_UNROLL for (int j = i; j < kSize; ++j) {
        to[i * kSize + j] = to[j * kSize + i] = pairs[pair++][lane];
      }
    }
  }
}

/// Derivative of the Gram matrices with respect to one parameter, whose effect on the polynomials'
/// coefficients is given.
template <int kOrder, int kRegressors>
void derivativeOf(const FusedSums<kOrder, kRegressors>& sums, const Polynomials& p,
                  const double* of_coefficients, Lanes* pairs) {
  constexpr int kPairs = FusedSums<kOrder, kRegressors>::kPairs;
  const std::array<Index, 4> sizes{p.b.size(), p.a.size(), p.c.size(), p.d.size()};
  std::fill_n(pairs, kPairs, Lanes(Lanes::Zero()));
  for (int kind = 0; kind < 4; ++kind) {
    for (Index k = 0; k < sizes[static_cast<std::size_t>(kind)]; ++k) {
      const double factor = kFusedSigns[kind] * *of_coefficients++;
      if (factor == 0) continue;
      const Lanes* of_coefficient = sums.derivatives[kind * kOrder + k];
      for (int pair = 0; pair < kPairs; ++pair) pairs[pair] += factor * of_coefficient[pair];
    }
  }
  int diagonal = 0;
  for (int i = 0; i <= kRegressors; diagonal += kRegressors + 1 - i, ++i) pairs[diagonal] *= 2;
}

template <int kOrder, int kRegressors>
void write(const FusedSums<kOrder, kRegressors>& sums, const Block& block, const Polynomials& p,
           const MatrixXd& jacobian, Statistics* statistics) {
  for (int lane = 0; lane < block.lanes; ++lane) {
    const int r = block.index[static_cast<std::size_t>(lane)];
    statistics->samples()[r] = block.lengths[static_cast<std::size_t>(lane)];
    statistics->logJacobian()[r] = 0;
    statistics->logJacobianDerivatives().col(r).setZero();
  }
  expand<kRegressors>(sums.gram, block, [&](int r) { return statistics->gram(r); });
  Lanes pairs[FusedSums<kOrder, kRegressors>::kPairs];
  for (int j = 0; j < static_cast<int>(jacobian.cols()); ++j) {
    derivativeOf(sums, p, jacobian.col(j).data(), pairs);
    expand<kRegressors>(pairs, block, [&](int r) { return statistics->gramDerivative(r, j); });
  }
}

template <int kOrder, int kRegressors>
void run(const Block& block, const Polynomials& p, const MatrixXd& T, const MatrixXd& jacobian,
         Statistics* statistics) {
  static const auto with_derivatives = chooseSweep<true, kOrder, kRegressors>();
  static const auto without = chooseSweep<false, kOrder, kRegressors>();
  const auto in = inputOf<kOrder, kRegressors>(block, p, T);
  FusedSums<kOrder, kRegressors> sums;
  (jacobian.cols() > 0 ? with_derivatives : without)(in, &sums);
  write(sums, block, p, jacobian, statistics);
}

using Run = void (*)(const Block&, const Polynomials&, const MatrixXd&, const MatrixXd&,
                     Statistics*);

constexpr Run kRuns[3][3] = {{run<1, 0>, run<1, 1>, run<1, 2>},
                             {run<2, 0>, run<2, 1>, run<2, 2>},
                             {run<4, 0>, run<4, 1>, run<4, 2>}};

}  // namespace

bool fusedAtRest(const Block& block, const Polynomials& p, const MatrixXd& T,
                 const MatrixXd& jacobian, Statistics* statistics) {
  const Index order = std::max({p.b.size(), p.a.size(), p.c.size(), p.d.size()});
  const Index regressors = T.cols();
  if (order > 4 || regressors > 2 || T.rows() > regressors + 1) return false;
  const int row = order <= 1 ? 0 : (order == 2 ? 1 : 2);
  kRuns[row][regressors](block, p, T, jacobian, statistics);
  return true;
}

}  // namespace uncertainty_identification
