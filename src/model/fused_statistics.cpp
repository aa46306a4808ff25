#include "model/fused_statistics.h"

#include <algorithm>

#include "model/box_jenkins_sweep.h"
#include "model/fused_at_rest.h"

namespace uncertainty_identification {

using Eigen::Index;

bool BoxJenkinsSweep::statistics(const Block& block, Statistics* statistics) const {
  if (block.gaps) return false;
  const bool at_rest = columns_.count() == 0 && model_.offset == 0 && !step_;
  if (at_rest && fusedAtRest(block, model_.p, T_, jacobian_, statistics)) return true;
  SweepStart start = rest();
  PiecewiseSweep sweep(model_, block, start);
  InitialValues first = initialValues(block, &sweep);
  start.values.swap(first.values.values());
  sweep.restart();
  Sums sums{LaneMatrix(size(), size()), LaneMatrix(derived() * size(), size()),
            LaneMatrix(1, size())};
  const SweepKernels& kernels = sweepKernels();
  while (sweep.next()) {
    const auto add = [&](const std::vector<const double*>& left, LaneMatrix* to) {
      kernels.products(left.data(), static_cast<int>(left.size()), sweep.values().data(),
                       static_cast<int>(size()), sweep.samples(), block.lanes, to->data());
    };
    add(sweep.values(), &sums.gram);
    if (derived() == 0) continue;
    sweep.differentiate(true);
    add(sweep.derivatives(), &sums.derivatives);
    if (!step_) continue;
    const double* step = step_->delayed(0) + sweep.begin();
    kernels.sharedProducts(&step, 1, sweep.values().data(), static_cast<int>(size()),
                           sweep.samples(), block.lanes, sums.of_step.data());
  }
  write(block, first, sums, statistics);
  return true;
}

void BoxJenkinsSweep::write(const Block& block, const InitialValues& first, const Sums& sums,
                            Statistics* statistics) const {
  for (int lane = 0; lane < block.lanes; ++lane) {
    const int r = block.index[static_cast<std::size_t>(lane)];
    const int length = block.lengths[static_cast<std::size_t>(lane)];
    statistics->samples()[r] = length;
    statistics->logJacobian()[r] = 0;
    statistics->logJacobianDerivatives().col(r).setZero();
    for (Index i = 0; i < size(); ++i) {
      for (Index j = 0; j < size(); ++j)
        statistics->gram(r)(i, j) = sums.gram(i, j)[lane] + first.prior(i, j)[lane];
    }
    if (columns_.count() == 0) continue;
    const Absorption& absorption = columns_.absorption(length);
    statistics->samples()[r] -= absorption.lost_samples;
    statistics->logJacobian()[r] = absorption.log_jacobian;
    if (derived() == 0) continue;
    statistics->logJacobianDerivatives().col(r).head(jacobian_.cols()).noalias() =
        jacobian_.transpose() * absorption.log_jacobian_derivatives;
  }
  if (derived() > 0) writeDerivatives(block, first, sums, statistics);
}

void BoxJenkinsSweep::writeDerivatives(const Block& block, const InitialValues& first,
                                       const Sums& sums, Statistics* statistics) const {
  const LaneMatrix halves = halvesOf(first, sums.derivatives);
  LaneMatrix half(size(), size());
  for (Index j = 0; j < jacobian_.cols(); ++j) {
    half.setZero();
    for (Index k = 0; k < derived(); ++k) {
      if (jacobian_(k, j) == 0) continue;
      for (Index i = 0; i < size() * size(); ++i) half(0, i) += jacobian_(k, j) * halves(k, i);
    }
    writeDerivative(block, half, static_cast<int>(j), statistics);
  }
  if (!step_) return;
  half.setZero();
  for (Index i = 0; i < size(); ++i) half(size() - 1, i) = -sums.of_step(0, i);
  writeDerivative(block, half, static_cast<int>(jacobian_.cols()), statistics);
}

/// d[Phi e]'[Phi e] for each coefficient (a row each): the derivative of the Gram matrix is the
/// sum of this and its transpose.
LaneMatrix BoxJenkinsSweep::halvesOf(const InitialValues& first,
                                     const LaneMatrix& derivatives) const {
  LaneMatrix halves(derived(), size() * size());
  for (Index k = 0; k < derived(); ++k) {
    for (Index i = 0; i < size(); ++i) {
      const double sign = (i + 1 == size() ? residual_signs_ : regressor_signs_)[k];
      for (Index j = 0; j < size(); ++j)
        halves(k, i * size() + j) = sign * derivatives(i * derived() + k, j);
    }
  }
  const Index first_of_noise = CoefficientLayout(model_.p).c;
  const auto& changes = columns_.covarianceDerivatives();
  for (std::size_t k = 0; k < changes.size(); ++k) {
    const Index row = first_of_noise + static_cast<Index>(k);
    for (Index l = 0; l < columns_.noise(); ++l) {
      for (Index m = 0; m < columns_.noise(); ++m) {
        const double change = -0.5 * changes[k](l, m);
        if (change == 0) continue;
        for (Index i = 0; i < size(); ++i) {
          const Lanes left = change * first.noise_residual(l, i);
          for (Index j = 0; j < size(); ++j)
            halves(row, i * size() + j) += left * first.noise_residual(m, j);
        }
      }
    }
  }
  return halves;
}

void BoxJenkinsSweep::writeDerivative(const Block& block, const LaneMatrix& half, int parameter,
                                      Statistics* statistics) const {
  for (int lane = 0; lane < block.lanes; ++lane) {
    Statistics::Gram to =
        statistics->gramDerivative(block.index[static_cast<std::size_t>(lane)], parameter);
    for (Index i = 0; i < size(); ++i) {
      for (Index j = 0; j < size(); ++j) to(i, j) = half(i, j)[lane] + half(j, i)[lane];
    }
  }
}

}  // namespace uncertainty_identification
