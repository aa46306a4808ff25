#pragma once

#include "inspection/survey.h"

namespace uncertainty_identification {

/// How much of what is new in two signals appears in both at the same reading.
struct AtOnce {
  double correlation = 0;  ///< of u(t) and y(t) given both pasts, -1 to 1
  double samples = 0;      ///< readings from which it was computed; 0: too few, or u hardly moves
  double p_value = 1;      ///< of no such correlation, by Fisher's transformation

  /// Beyond chance, and so much that it matters. A plant that answers at least one sample later
  /// shows no such correlation, unless a controller computes the input from the same reading.
  bool matters() const;
};

/// The partial correlation at the output's own rate: of what six earlier values of both signals
/// do not predict. An input that seldom moves is not computed from the output: it has none.
AtOnce atOnceOf(const Channel& input, const Channel& output);

}  // namespace uncertainty_identification
