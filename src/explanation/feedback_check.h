#pragma once

#include "explanation/fit.h"

namespace uncertainty_identification {

/// Result of a test for a closed loop.
struct FeedbackTest {
  double p_value = 1;
  double share = 0;  ///< of the variance of what is new in the input, explained by the residuals
};

/// Tests whether the part of the residuals that their own past does not predict correlates with
/// that part of the next four inputs (docs/explanation.md, exp_feedback). Finds nothing where it
/// correlates as much with much later inputs, where there are too few samples, or where a signal is
/// predictable from its own past throughout.
FeedbackTest testFeedback(const Residuals& residuals, const FitData& data);

}  // namespace uncertainty_identification
