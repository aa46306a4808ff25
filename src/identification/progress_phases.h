#pragma once

#include <optional>

#include "estimation/stopwatch.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// The phases of an identification, in their order.
enum class Phase { check, orders, plant, structure, start, components, optimum, errors };

/// Reports the progress of an identification to the caller. The reported fraction never decreases,
/// even if a phase is repeated. Knows whether the identification is to end before it is done,
/// because the caller has cancelled or there is no time left.
class ProgressPhases {
 public:
  /// `time_limit` [s] counts from here; 0: none.
  explicit ProgressPhases(const ProgressCallback& callback, double time_limit = 0)
      : callback_(callback), time_limit_(time_limit) {}

  /// A share of `phase` is done. False once the search is to end.
  bool report(Phase phase, double share, std::optional<double> log_likelihood = {});

  /// Reports the last progress once more. Returns whether the caller has cancelled, or the time is
  /// over: then everything ends at once.
  bool mustEnd();

  /// Whether the search is to end with the best that was found: once the caller has cancelled, or
  /// when the rest of the time is needed to describe the model.
  bool searchEnds() const;

  /// Whether there is time for a second search as long as the first, which has just ended.
  bool allowsAnother() const;

  bool cancelled() const { return cancelled_; }

 private:
  bool isOver(double share_of_time) const;
  void call();

  ProgressCallback callback_;
  double time_limit_;
  Stopwatch watch_;
  Progress last_;
  bool cancelled_ = false;
};

}  // namespace uncertainty_identification
