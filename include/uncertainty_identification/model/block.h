#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Experiments computed side by side: recursive filters are sequential in time but independent
/// across experiments.
constexpr int kLanes = 8;

/// One value per experiment of a block.
using Lanes = Eigen::Array<double, kLanes, 1>;

/// One signal of a block: row = experiment (lane), column = sample.
using Signals = Eigen::Array<double, kLanes, Eigen::Dynamic>;

/// Up to kLanes experiments of similar length, samples interleaved. Lanes and samples not in use
/// hold zeros.
struct Block {
  int lanes = 0;                                        ///< experiments in use
  int samples = 0;                                      ///< of the longest
  std::array<int, kLanes> lengths{};                    ///< of each experiment
  std::array<int, kLanes> index{};                      ///< each experiment's place in the data set
  std::array<const Experiment*, kLanes> experiments{};  ///< for covariates; outlive the block
  bool gaps = false;    ///< some output before an experiment's end is missing
  bool ragged = false;  ///< the experiments in use differ in length
  Signals u, y;         ///< y is 0 where missing
  Signals weight;       ///< 1 where y was measured, else 0
};

/// Packs experiments into blocks, grouped by length. The experiments must outlive the blocks.
std::vector<Block> makeBlocks(const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
