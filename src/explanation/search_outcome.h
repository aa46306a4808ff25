#pragma once

#include <functional>
#include <limits>
#include <optional>
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
  std::string chosen_orders = "";   ///< orderText() of the model that others were tried beside
  std::string simplification = "";  ///< of the orders, as a warning tells it
  bool may_move_in_steps = false;   ///< the actuator, as findInputSteps() says

  /// Whether a cause isInEveryExperiment() and all tests pass with the causes.
  bool explainsAll() const;

  /// Log-likelihood with the causes, minus the BIC penalties of the model and of the causes [nats].
  /// Outcomes on top of models of different orders are compared by it.
  double penalisedLikelihood() const;
};

/// What `search` finds on top of each model, until one explains all: those of other orders beside
/// the one that was chosen. Models that cannot be evaluated are passed over; throws DataError where
/// none can.
std::vector<SearchOutcome> outcomesOf(const std::vector<Estimate>& candidates,
                                      const Estimate& chosen,
                                      const std::function<SearchOutcome(const Estimate&)>& search,
                                      const std::function<bool()>& in_time);

/// How likely the causes make the data.
struct AnswerLikelihood {
  double training = -std::numeric_limits<double>::infinity();  ///< [nats], minus BIC penalties
  std::optional<double> held_out;                              ///< [nats] per experiment
  double samples = 0;                                          ///< that were fitted to
  std::vector<std::string> causes{};                           ///< names of those that count
};

/// Minus infinity where nothing was found that isInEveryExperiment() and no line of the spectrum,
/// or where causes of the noise count as well.
AnswerLikelihood likelihoodOf(const SearchOutcome& outcome);

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
/// between models is no reason to name one. But where the model of that outcome has a line of the
/// spectrum as poles that nothing damps, one that names the line and is as likely within 3 nats is
/// taken.
SearchOutcome* bestOf(std::vector<SearchOutcome>* outcomes, double acceptance);

}  // namespace uncertainty_identification
