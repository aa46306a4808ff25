#include "model/box_jenkins_sweep.h"

#include <algorithm>

#include "model/evaluation.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

std::vector<int> lengthsOf(const std::vector<Block>& blocks) {
  std::vector<int> lengths;
  for (const Block& block : blocks)
    lengths.insert(lengths.end(), block.lengths.begin(), block.lengths.begin() + block.lanes);
  return lengths;
}

/// The signs of the derivatives of all coefficients [b; a; c; d].
VectorXd signsOf(const Polynomials& p, const double (&of_kinds)[4]) {
  VectorXd signs(p.b.size() + p.a.size() + p.c.size() + p.d.size());
  Index at = 0;
  const std::array<Index, 4> sizes{p.b.size(), p.a.size(), p.c.size(), p.d.size()};
  for (std::size_t kind = 0; kind < sizes.size(); ++kind) {
    signs.segment(at, sizes[kind]).setConstant(of_kinds[kind]);
    at += sizes[kind];
  }
  return signs;
}

}  // namespace

BoxJenkinsSweep::BoxJenkinsSweep(const FusedInput& input, const MatrixXd& T,
                                 const EstimationOptions& options, const std::vector<Block>& blocks)
    : model_(input.polynomials, T, input.common_offset),
      T_(T),
      jacobian_(input.jacobian),
      columns_(input.polynomials, input.states, options, lengthsOf(blocks), jacobian_.size() > 0),
      residual_signs_(signsOf(model_.p, PiecewiseSweep::kResidualSigns)),
      regressor_signs_(signsOf(model_.p, PiecewiseSweep::kRegressorSigns)) {
  for (int k = 0; k < columns_.count(); ++k) column_.push_back(columns_.column(k));
  if (!estimatesCommonOffset(options) || jacobian_.size() == 0) return;
  const std::vector<int> lengths = lengthsOf(blocks);
  const int longest = *std::max_element(lengths.begin(), lengths.end());
  const int lag = static_cast<int>(std::max(model_.p.c.size(), model_.p.d.size()));
  step_ = SharedSignal::step(longest, lag).dividedBy(model_.p.c).times(model_.p.d);
}

SweepStart BoxJenkinsSweep::rest() const {
  return {columns_.noise(), columns_.states(), columns_.ownOffset(), {}};
}

/// Estimates the initial values, with a sweep that starts from rest and ends where the columns do.
BoxJenkinsSweep::InitialValues BoxJenkinsSweep::initialValues(const Block& block,
                                                              PiecewiseSweep* sweep) const {
  const Index count = columns_.count(), m = columns_.noise();
  InitialValues found{LaneMatrix(count, size()), LaneMatrix(size(), size()), LaneMatrix(m, size())};
  if (count == 0) return found;
  LaneMatrix products(count, size());
  const int end = columns_.ownOffset() ? block.samples : columns_.duration();
  while (sweep->begin() + sweep->samples() < end && sweep->next())
    addColumnProducts(block, *sweep, sweep->values(), &products);
  const AbsorptionOfLanes of_lanes = absorptions(block);
  found.values = mapped(of_lanes, &Absorption::estimate, count, products);
  found.noise_residual = mapped(of_lanes, &Absorption::noise_residual, m, products);
  const LaneMatrix weighted = mapped(of_lanes, &Absorption::prior, count, products);
  for (Index k = 0; k < count; ++k) {
    for (Index i = 0; i < size(); ++i) {
      for (Index j = 0; j < size(); ++j) found.prior(i, j) += products(k, i) * weighted(k, j);
    }
  }
  return found;
}

BoxJenkinsSweep::AbsorptionOfLanes BoxJenkinsSweep::absorptions(const Block& block) const {
  AbsorptionOfLanes all;
  for (std::size_t lane = 0; lane < all.size(); ++lane) {
    const bool used = lane < static_cast<std::size_t>(block.lanes);
    all[lane] = &columns_.absorption(block.lengths[used ? lane : 0]);
  }
  return all;
}

/// The product of a matrix, which may differ between lanes, and `right`.
LaneMatrix BoxJenkinsSweep::mapped(const AbsorptionOfLanes& of_lanes, MatrixXd Absorption::*matrix,
                                   Index rows, const LaneMatrix& right) const {
  LaneMatrix out(rows, right.columns());
  for (Index i = 0; i < rows; ++i) {
    for (Index k = 0; k < right.rows(); ++k) {
      Lanes factor;
      for (std::size_t lane = 0; lane < of_lanes.size(); ++lane)
        factor[static_cast<Index>(lane)] = (of_lanes[lane]->*matrix)(i, k);
      for (Index j = 0; j < right.columns(); ++j) out(i, j) += factor * right(k, j);
    }
  }
  return out;
}

/// Adds this piece of Z'signals; columns that have vanished are left out.
void BoxJenkinsSweep::addColumnProducts(const Block& block, const PiecewiseSweep& sweep,
                                        const std::vector<const double*>& signals,
                                        LaneMatrix* products) const {
  const bool vanished = sweep.begin() >= columns_.duration();
  if (vanished && !columns_.ownOffset()) return;
  const Index first = vanished ? columns_.count() - 1 : 0;
  std::vector<const double*> columns(column_.begin() + first, column_.end());
  for (const double*& column : columns) column += sweep.begin();
  sweepKernels().sharedProducts(columns.data(), static_cast<int>(columns.size()), signals.data(),
                                static_cast<int>(signals.size()), sweep.samples(), block.lanes,
                                (*products)(first, 0).data());
}

std::unique_ptr<const FusedSweep> fusedBoxJenkins(const FusedInput& input, const ErrorBasis& basis,
                                                  const EstimationOptions& options,
                                                  const std::vector<Block>& blocks) {
  const bool at_input =
      options.offsets != Offsets::none && options.offset_side == OffsetSide::input;
  if (basis.kind() != BasisKind::fir || options.initial_state == InitialState::discard || at_input)
    return nullptr;
  return std::make_unique<BoxJenkinsSweep>(input, basis.T(), options, blocks);
}

}  // namespace uncertainty_identification
