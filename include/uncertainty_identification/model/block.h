#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Number of experiments that are computed side by side. Recursive filters must step through time,
/// but experiments are independent of each other, so one vector instruction can serve several.
constexpr int kLanes = 8;

/// One value per experiment of a block.
using Lanes = Eigen::Array<double, kLanes, 1>;

/// One signal of a block: row = experiment (lane), column = sample.
using Signals = Eigen::Array<double, kLanes, Eigen::Dynamic>;

/// The signal with `samples` samples: zeros follow where it is shorter.
Signals withZerosUntil(Eigen::Index samples, const Signals& signal);

/// Up to kLanes experiments of similar length with interleaved samples. Unused lanes and samples
/// are zero.
struct Block {
  int lanes = 0;                      ///< experiments in use
  int samples = 0;                    ///< length of the longest experiment
  std::array<int, kLanes> lengths{};  ///< length of each experiment
  std::array<int, kLanes> index{};    ///< index of each experiment in the data set
  std::array<const Experiment*, kLanes>
      experiments{};    ///< needed for covariates; must outlive the block
  bool gaps = false;    ///< whether an output is missing before the end of an experiment
  bool ragged = false;  ///< whether the experiments differ in length
  Signals u, y;         ///< y is 0 where it was not measured
  Signals weight;       ///< 1 where y was measured, otherwise 0
};

/// Packs experiments into blocks of similar length. The experiments must outlive the blocks.
std::vector<Block> makeBlocks(const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
