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
/// 95 % of the other samples of their experiment, more than a twentieth of the output's range, and
/// than three steps of its resolution. None where they lie behind large changes of the input more
/// often than by chance (binomial test, p < 0.01), as the answers of a plant do that passes changes
/// only; where they are more than the share `most` (limits.max_stray); and, unless they are
/// `expected`, as others of the sensor show some, where there are fewer than three, or less than
/// one in 1,000, as extremes of noise with heavy tails are, but for those that lie three times the
/// range of all others from their neighbours, and not behind a large change of the input.
StrayReadings strayReadings(const std::vector<Experiment>& experiments, double most,
                            bool expected = false);

/// The experiments with these samples marked as missing.
std::vector<Experiment> without(const StrayReadings& stray, std::vector<Experiment> experiments);

/// What a user should know, in a sentence; empty where there are none.
std::string strayText(const StrayReadings& stray, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
