#pragma once

#include <string>
#include <vector>

#include "explanation/sample_checks.h"
#include "explanation/search.h"
#include "explanation/split.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// A model without causes, and the result of the search for causes on top of it.
struct SearchOutcome {
  Estimate estimate;        ///< of the model
  SearchState base, found;  ///< before and after the search
  std::vector<TriedEffect> tried;
  Refusals refusals;

  /// Log-likelihood with the causes, minus the BIC penalties of the model and of the causes [nats].
  /// Outcomes on top of models of different orders are compared by it.
  double penalisedLikelihood() const;
};

/// The context of fits that start from an estimate. It has no threads, and its callbacks do
/// nothing.
FitContext contextOf(const Estimate& estimate, std::uint64_t seed);

/// Looks for causes on top of an estimate, among users' own effects and those named by `only`;
/// empty: among all. The
/// estimate was made from `data.train`, with the samples masked that are `spoilt`.
SearchOutcome searchOnTopOf(ExplanationOptions options, const FitContext& context,
                            Estimate estimate, const Split& data,
                            const std::vector<SpoiltSamples>& spoilt,
                            const std::vector<std::string>& only);

/// The outcome of the highest penalised likelihood, less `acceptance` [nats] for each cause: a tie
/// between models is no reason to name one.
SearchOutcome* bestOf(std::vector<SearchOutcome>* outcomes, double acceptance);

}  // namespace uncertainty_identification
