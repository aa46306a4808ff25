#pragma once

#include <optional>
#include <string>
#include <vector>

#include "explanation/candidates.h"
#include "explanation/measure.h"
#include "explanation/residual_distribution.h"
#include "uncertainty_identification/effects/catalogue.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// A cause that was taken in, with the models before and after.
struct FoundCause {
  std::shared_ptr<const Effect> effect;
  double score = 0, penalty = 0;
  double confidence = 1;
  std::vector<std::string> equivalent;
  std::optional<Gain> gain;
  std::vector<CauseParameter> parameters;  ///< of causes outside the chain
};

/// Where a search stands: a model with causes taken in, and the data as far as they are not spoilt.
struct SearchState {
  Fit fit;
  FitData train, held;
  std::vector<FoundCause> causes;
  std::vector<std::string> banned;
  bool heavy_tails = false;
  bool quantised = false;   ///< the lattice of the output is coarse against the noise
  bool eliminated = false;  ///< something was taken out again
  double total = 0;         ///< [nats] of likelihood gained, less the causes' penalties
  bool fitted_to = false;   ///< held are the experiments of train

  bool has(const std::string& name) const;
  /// What one model gains over another by log density.
  PairedGains gains(const Fit& before, const Fit& after) const;
};

/// Looks for causes on top of a base fit: the loop of docs/explanation.md.
class Search {
 public:
  Search(const ExplanationOptions& options, FitContext context, Effects catalogue);

  /// The best set of causes: greedily, and where one cause does not settle the matter, from the
  /// next best first causes too that are none of the noise: what absorbs much must not win by that.
  SearchState run(const SearchState& base);

  const std::vector<TriedEffect>& tried() const { return tried_; }

 private:
  SearchState search(const SearchState& base);
  void updateTried(const FoundCause& first);
  void forwardSelection(SearchState* state, std::size_t most);
  bool extend(SearchState* state, const std::vector<FittedEffect>& ranked);
  std::vector<FittedEffect> rank(const SearchState& state);
  bool accept(SearchState* state, const FittedEffect& candidate,
              const std::vector<FittedEffect>& ranked);
  bool acceptDistribution(SearchState* state, const FittedEffect& best);
  void eliminate(SearchState* state);
  Effects considered(const SearchState& state) const;
  double threshold(const Effect& effect) const;
  bool beatsSimulation(const SearchState& state, const FittedEffect& candidate) const;

  ExplanationOptions options_;
  FitContext context_;
  Effects catalogue_;
  std::vector<TriedEffect> tried_;
  int rankings_ = 0;
};

}  // namespace uncertainty_identification
