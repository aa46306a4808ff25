#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Output samples that stray from both their neighbours, as an echo that is lost or a bit that is
/// flipped does.
struct StrayReadings {
  std::vector<std::vector<int>> samples;  ///< of each experiment, rising
  int count = 0;
  double share = 0;  ///< of all measured samples
  double size = 0;   ///< median distance from the neighbours [unit of y]
};

/// Single output samples far from the four around them, which lie close together: 8 times as far as
/// 95 % of the other samples of their experiment, and more than a twentieth of the output's range.
/// None where the input has a pulse of one sample shortly before, where there are fewer than three,
/// or where they are less than one in 1,000 of the samples, as extremes of noise with heavy tails
/// are, or more than the share `most` (limits.max_stray).
StrayReadings strayReadings(const std::vector<Experiment>& experiments, double most);

/// The experiments with these samples marked as missing.
std::vector<Experiment> without(const StrayReadings& stray, std::vector<Experiment> experiments);

/// What a user should know, in a sentence; empty where there are none.
std::string strayText(const StrayReadings& stray, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
