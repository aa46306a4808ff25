#pragma once

#include <optional>

#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// The phases of an identification, in their order.
enum class Phase { check, orders, plant, structure, start, components, optimum, errors };

/// Reports the progress of an identification to the caller. The reported fraction never decreases,
/// even if a phase is repeated. Also stores whether the caller has cancelled.
class ProgressPhases {
 public:
  explicit ProgressPhases(const ProgressCallback& callback) : callback_(callback) {}

  /// A share of `phase` is done. False once the caller has cancelled.
  bool report(Phase phase, double share, std::optional<double> log_likelihood = {});

  bool cancelled() const { return cancelled_; }

 private:
  ProgressCallback callback_;
  double fraction_ = 0;
  bool cancelled_ = false;
};

}  // namespace uncertainty_identification
