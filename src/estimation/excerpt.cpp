#include "estimation/excerpt.h"

#include <algorithm>

#include "data/bridged_output.h"

namespace uncertainty_identification {

Experiment excerpt(const Experiment& whole, int first, int count) {
  Experiment piece = whole;
  piece.u = whole.u.segment(first, count);
  piece.y = whole.y.segment(first, count);
  if (!whole.valid.empty())
    piece.valid.assign(whole.valid.begin() + first, whole.valid.begin() + first + count);
  piece.signals.clear();
  piece.stamp_offset.resize(0);
  return piece;
}

int longestOf(const std::vector<Experiment>& experiments) {
  int longest = 0;
  for (const Experiment& experiment : experiments)
    longest = std::max(longest, experiment.samples());
  return longest;
}

std::vector<Experiment> bridged(std::vector<Experiment> experiments) {
  for (Experiment& experiment : experiments) {
    if (experiment.validSamples() == experiment.samples()) continue;
    experiment.y = bridgedOutput(experiment);
    experiment.valid.clear();
  }
  return experiments;
}

std::vector<Experiment> fewerSamples(const std::vector<Experiment>& experiments, int enough) {
  long total = 0;
  for (const Experiment& experiment : experiments) total += experiment.samples();
  if (total <= enough) return experiments;
  std::vector<Experiment> fewer;
  constexpr int kShortest = 500;  // [samples] a shorter beginning shows too little of slow dynamics
  const double share = static_cast<double>(enough) / static_cast<double>(experiments.size());
  const int head = std::max(static_cast<int>(share), kShortest);
  double credit = 0;  // number of samples that may still be taken
  for (const Experiment& experiment : experiments) {
    const int taken = std::min(experiment.samples(), head);
    credit += share;
    if (credit < taken) continue;
    credit -= taken;
    fewer.push_back(excerpt(experiment, 0, taken));
  }
  return fewer;
}

}  // namespace uncertainty_identification
