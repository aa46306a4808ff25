#pragma once

#include "inspection/at_once.h"
#include "inspection/survey.h"

namespace uncertainty_identification {

/// How two signals follow each other in time: correlations of what is new in one (what its own past
/// does not predict) with what is new in the other, later or earlier. Without feedback, what is new
/// in the input is independent of all that was new in the output before.
struct Following {
  bool measured = false;  ///< false: too few samples in common, or one signal predicts itself
  double after = 0;       ///< largest absolute correlation of y with the same or an earlier u
  double delay = 0;       ///< [s] by which that u is earlier; 0: both move in the same reading
  double before = 0;      ///< largest absolute correlation of y with a later u
  double lead = 0;        ///< [s] by which that u is later
  double chance = 0;      ///< size that such a correlation reaches without any dependence
  double period = 0;      ///< [s] at which both were read; delays are multiples of it
  AtOnce at_once;         ///< at the output's own rate; there from fewer samples than the others

  /// Whether y follows u, and whether u follows y, beyond chance and to an extent that matters.
  /// What the past of a signal does not predict linearly also correlates a little the wrong way
  /// round: a signal is said to follow only where it does so at least half as much as the other.
  bool outputFollows() const;
  bool inputFollows() const;

  /// Whether most of what is new in one signal appears in the other within the same reading, so
  /// that either may cause the other.
  bool moveTogether() const;
};

/// Both signals are read at `period` [s], held; 0: at ten samples a period of the output's
/// bandwidth, at most at its own rate.
Following followingOf(const Channel& input, const Channel& output, double output_band,
                      double period = 0);

}  // namespace uncertainty_identification
