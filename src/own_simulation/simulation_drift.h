#pragma once

#include <array>
#include <string>
#include <vector>

#include "own_simulation/simulation_errors.h"

namespace uncertainty_identification {

/// Whether the errors of a simulation are no longer what they were.
struct DriftDecision {
  bool drifted = false;
  /// A sentence: which numbers differ, from what to what; or that none does; or that there are too
  /// few experiments.
  std::string message;
};

/// Compares the errors of the newest experiments with those of the first ones.
///
/// Of fit, bias, gain and delay error each, the mean of the newest five experiments is compared
/// with that of the first ten by Student's t with the spread within both groups; of n < 15
/// experiments the newest n / 3 with the first ones of the rest, and of fewer than six none. The
/// variance is at least the mean of the squared standard errors. A number differs if its
/// probability is below 0.00025 were there no drift, so that at most one decision of a thousand is
/// a false alarm, and one stream of eighteen has one within a hundred experiments. That differences
/// between experiments are normally distributed is assumed.
class SimulationDrift {
 public:
  void add(const SimulationErrors& errors);

  DriftDecision decision() const;

 private:
  struct Entry {
    double value = 0, squared_error = 0;
  };

  /// One number in the first and in the newest experiments that told it.
  struct History {
    std::vector<Entry> first, newest;
    int count = 0;
  };

  static void append(const ErrorNumber& number, History* history);
  static std::string differenceOf(const History& history, const char* name, const char* unit);

  int experiments_ = 0;
  std::array<History, 4> histories_;  // fit, bias, gain, delay
};

}  // namespace uncertainty_identification
