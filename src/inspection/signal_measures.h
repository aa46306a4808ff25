#pragma once

#include <optional>

#include "inspection/survey.h"

namespace uncertainty_identification {

/// How a signal moves.
enum class SignalShape {
  constant,
  two_levels,  ///< a relay, a pseudo-random binary signal, a single step
  steps,       ///< holds its values and leaps between them, as commands do
  continuous
};

/// What can be said about a signal by itself. Values are in the unit in which it is stored.
struct SignalMeasures {
  long samples = 0;
  double smallest = 0, largest = 0;
  double resolution = 0;  ///< step of which all differences are multiples; 0: none to be seen
  double held = 0;        ///< share of the samples that repeat the one before
  double at_smallest = 0, at_largest = 0;  ///< share of the samples that stay at an extreme value
  bool clipped = false;  ///< moves continuously, but stays at an extreme for a while
  long levels = 0;       ///< different values, counted up to 1,000
  SignalShape shape = SignalShape::constant;
  std::optional<double> band;  ///< [Hz] 99.5 % of the power of the detrended signal lie below
};

SignalMeasures measure(const Channel& channel);

/// SignalMeasures::band of the longest record; nothing where it is too short or does not move.
std::optional<double> bandHertz(const Channel& channel);

}  // namespace uncertainty_identification
