#pragma once

#include <optional>
#include <string>
#include <vector>

#include "explanation/candidates.h"
#include "explanation/measure.h"
#include "explanation/refusals.h"
#include "explanation/residual_checks.h"
#include "explanation/residual_distribution.h"
#include "uncertainty_identification/effects/catalogue.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// An effect that was accepted as a cause.
struct FoundCause {
  std::shared_ptr<const Effect> effect;
  double score = 0, penalty = 0;           ///< [nats] as those of FittedEffect
  double confidence = 1;                   ///< as confidenceFor()
  std::vector<std::string> equivalent;     ///< as equivalentOf()
  bool may_be_order = false;               ///< as mayBeOrder(), and the orders were not stated
  std::optional<Gain> gain;                ///< on the held-out experiments
  std::vector<CauseParameter> parameters;  ///< only of causes that are no part of the chain of
                                           ///< signals; those of the others are in the fit
};

/// The state of a search: the model with the causes accepted so far, and the data with their
/// outliers masked.
struct SearchState {
  Fit fit;              ///< to `train`
  FitData train, held;  ///< experiments to fit to, and to measure gains on
  std::vector<FoundCause> causes;
  std::vector<std::string> banned;  ///< names of effects that are not tried any more
  ResidualLaw law = ResidualLaw::gaussian;
  std::string remark = "";  ///< on the samples, for people; may be empty
  bool eliminated = false;  ///< a cause was removed by backward elimination
  double total = 0;  ///< [nats] gain of log-likelihood over the base, minus the causes' penalties
  bool fitted_to = false;  ///< too few experiments to hold any out: `held` are those of `train`

  bool has(const std::string& name) const;
  /// Whether a cause leaves an effect nothing to describe (EffectDescription::excludes).
  bool excludes(const Effect& effect) const;
  /// Gains of log density of the model `after` over the model `before`.
  PairedGains gains(const Fit& before, const Fit& after) const;
};

/// Looks for causes on top of a base fit by greedy forward selection with backward elimination
/// (docs/explanation.md).
class Search {
 public:
  Search(const ExplanationOptions& options, FitContext context, Effects catalogue);

  /// The set of causes with the highest penalised likelihood that is found. If one cause does not
  /// explain the data, the search restarts from the three best structural causes, that is those
  /// outside noise and mixture. Otherwise an effect such as coloured noise would win, since it fits
  /// anything.
  SearchState run(const SearchState& base);

  /// The causes of a state, and the next one that forward selection adds to them, if there is one.
  SearchState withAnother(SearchState found);

  /// The effects that were tried on top of the base, the best score first.
  const std::vector<TriedEffect>& tried() const { return tried_; }

  const Refusals& refusals() const { return refusals_; }

 private:
  SearchState search(const SearchState& base);
  SearchState measured(const SearchState& base, SearchState found);
  void updateTried(const FoundCause& first);
  void forwardSelection(SearchState* state, std::size_t most);
  bool extend(SearchState* state, const std::vector<FittedEffect>& ranked);
  std::vector<FittedEffect> rank(const SearchState& state);
  bool accept(SearchState* state, const FittedEffect& candidate,
              const std::vector<FittedEffect>& ranked);
  bool acceptDistribution(SearchState* state, const FittedEffect& best);
  void eliminate(SearchState* state);
  void removeThoseThatHoldNoMore(const SearchState& base, SearchState* found);
  bool isWanted(const Effect& effect, const SearchState& state) const;
  Effects considered(const SearchState& state) const;
  void banDistributions(SearchState* state) const;
  double threshold(const Effect& effect) const;
  bool beatsSimulation(const SearchState& state, const FittedEffect& candidate) const;

  ExplanationOptions options_;
  FitContext context_;
  Effects catalogue_;
  std::vector<TriedEffect> tried_;
  Refusals refusals_;
  int rankings_ = 0;
};

}  // namespace uncertainty_identification
