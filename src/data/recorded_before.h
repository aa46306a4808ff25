#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_set>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Recognises experiments that come again: a looped bag brings the same stamps and samples pass
/// after pass, and none of them must count twice. Two are the same when their start times and their
/// fingerprints (dataFingerprint) are; ids are not looked at. The newest 10,000 are remembered.
class RecordedBefore {
 public:
  /// Remembers the experiment. False when it is remembered already.
  bool add(const Experiment& experiment);

  /// The experiment was taken out on request. It is still recognised when it comes again by itself,
  /// but may be asked for.
  void takeOut(const Experiment& experiment);

  /// Whether the experiment, now asked for, will be added: it is not remembered, or was taken out,
  /// which is forgotten with it.
  bool readmit(const Experiment& experiment);

  void clear();

  static constexpr std::size_t kRemembered = 10000;

 private:
  std::unordered_set<std::uint64_t> keys_;
  std::unordered_set<std::uint64_t> taken_out_;  // of keys_
  std::deque<std::uint64_t> order_;              // oldest first
};

}  // namespace uncertainty_identification
