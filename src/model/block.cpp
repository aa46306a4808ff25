#include "uncertainty_identification/model/block.h"

#include <algorithm>
#include <numeric>

namespace uncertainty_identification {
namespace {

void place(const Experiment& experiment, int index, int lane, Block* block) {
  const auto at = static_cast<std::size_t>(lane);
  const int samples = experiment.samples();
  block->lengths[at] = samples;
  block->index[at] = index;
  block->experiments[at] = &experiment;
  for (int k = 0; k < samples; ++k) {
    const bool valid = experiment.isValid(k);
    block->u(lane, k) = experiment.u[k];
    block->y(lane, k) = valid ? experiment.y[k] : 0.0;
    block->weight(lane, k) = valid ? 1.0 : 0.0;
    block->gaps = block->gaps || !valid;
  }
}

}  // namespace

Signals withZerosUntil(Eigen::Index samples, const Signals& signal) {
  Signals all = Signals::Zero(kLanes, samples);
  const Eigen::Index known = std::min(samples, signal.cols());
  all.leftCols(known) = signal.leftCols(known);
  return all;
}

std::vector<Block> makeBlocks(const std::vector<Experiment>& experiments) {
  std::vector<int> order(experiments.size());
  std::iota(order.begin(), order.end(), 0);
  const auto samples = [&](int r) { return experiments[static_cast<std::size_t>(r)].samples(); };
  std::stable_sort(order.begin(), order.end(),
                   [&](int l, int r) { return samples(l) > samples(r); });

  std::vector<Block> blocks;
  for (std::size_t first = 0; first < order.size(); first += kLanes) {
    Block block;
    block.lanes = static_cast<int>(std::min<std::size_t>(kLanes, order.size() - first));
    block.samples = samples(order[first]);
    block.u = block.y = block.weight = Signals::Zero(kLanes, block.samples);
    for (int lane = 0; lane < block.lanes; ++lane) {
      const int r = order[first + static_cast<std::size_t>(lane)];
      place(experiments[static_cast<std::size_t>(r)], r, lane, &block);
    }
    block.ragged = block.lengths[0] != block.lengths[static_cast<std::size_t>(block.lanes) - 1];
    blocks.push_back(std::move(block));
  }
  return blocks;
}

}  // namespace uncertainty_identification
