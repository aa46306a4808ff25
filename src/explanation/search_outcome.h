#pragma once

#include <vector>

#include "explanation/sample_checks.h"
#include "explanation/search.h"
#include "explanation/split.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// A model, and the causes that are found on top of it.
struct SearchOutcome {
  Estimate estimate;
  SearchState base, found;
  std::vector<TriedEffect> tried;

  /// [nats] Likelihood less what BIC charges for the model's and the causes' parameters: by this
  /// attempts on top of different models compare.
  double merit() const;
};

/// The context of fits that start from an estimate: without threads and callbacks.
FitContext contextOf(const Estimate& estimate, std::uint64_t seed);

/// Looks for causes on top of an estimate of `data.train`, out of which what the spoilt spoil
/// was taken.
SearchOutcome searchOnTopOf(const ExplanationOptions& options, const FitContext& context,
                            Estimate estimate, const Split& data,
                            const std::vector<SpoiltSamples>& spoilt);

}  // namespace uncertainty_identification
