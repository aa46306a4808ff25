#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_set>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Recognises experiments that arrive repeatedly: a bag played in a loop brings the same
/// experiments in every pass, and none must be used twice. Two experiments are the same if their
/// start times and fingerprints (dataFingerprint) are equal; ids do not matter. The newest 10,000
/// are remembered.
class RecordedBefore {
 public:
  /// Remembers the experiment. False if it was remembered before.
  bool add(const Experiment& experiment);

  /// To be called when the experiment was removed on request. It is still recognised when it
  /// arrives again, but readmit() will accept it.
  void takeOut(const Experiment& experiment);

  /// Whether an experiment that somebody asks for may be added: it is not remembered, or it was
  /// taken out, which this call cancels.
  bool readmit(const Experiment& experiment);

  void clear();

  static constexpr std::size_t kRemembered = 10000;

 private:
  std::unordered_set<std::uint64_t> keys_;
  std::unordered_set<std::uint64_t> taken_out_;  // of keys_
  std::deque<std::uint64_t> order_;              // oldest first
};

}  // namespace uncertainty_identification
