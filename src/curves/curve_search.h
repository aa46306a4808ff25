#pragma once

#include <string>
#include <vector>

#include "curves/found_curve.h"

namespace uncertainty_identification {

/// What the first cause was chosen from. Empty where it was only found beyond what differs between
/// experiments.
struct FirstChoice {
  WindowFit before;                    ///< the fit without it
  Eigen::VectorXd unseen;              ///< unseenErrors() of before
  double chosen_unseen = 0;            ///< sum of those with the cause
  std::vector<CurveCandidate> others;  ///< the best of each place that was not tied, best first
};

struct CurveSearchResult {
  WindowFit base, fit;
  FirstChoice first;
  std::vector<FoundCurve> causes;   ///< in the order found; fit.model.curves may have another one
  std::vector<FoundCurve> refused;  ///< simulate better, but a controller may be why; not named
  double held_error = 0;            ///< squared, of all held-out windows
  bool is_unstable = false;         ///< curves were refused because the plant is unstable
  bool ended_early = false;
};

struct CurveSearchLimits {
  int max_causes = 3;
  CandidateLimits candidates;
  double least_t = 3;        ///< paired, over all unseen windows, left out or held out
  double least_gain = 0.08;  ///< of the squared error of unseen windows, and of held-out ones alone
  double least_first_gain = 0.15;  ///< of held-out ones by the first cause; less is immaterial
  double least_share = 0.03;       ///< of the base's squared error of unseen windows
  double least_held_t = 1.7;       ///< paired, over held-out windows: 95 %, one-sided
  double clear_fit = 75;           ///< [%] held out; below it the causes must predict better, too:
  double least_prediction_gain = 0.02;  ///< of the squared error
  double least_prediction_t = 2;        ///< paired, over held-out windows
  double good_fit = 98.5;               ///< [%] below it, a plant of first order is tried as well
  double least_fit = 30;        ///< [%] held out, with the causes: a poor simulation names nothing
  bool compares_places = true;  ///< also searches with other places first
  /// Causes of another search, which are taken where they simulate far better than those found.
  const CurveSearchResult* suggested = nullptr;
};

/// Whether a search from another plant ends better: with a tenth less left out, or as well with
/// fewer causes. More causes have to leave out less by a share of what the plant without causes
/// does, as each cause of a search has to.
bool isBetter(const CurveSearchResult& other, const CurveSearchResult& than, double least_share);

/// Looks for the curves that the free simulation of a small linear model lacks. `held` decides
/// about what is accepted. Deterministic; the number of threads does not matter.
CurveSearchResult searchCurves(const SimulationData& data, const SimulationData& held,
                               const CurveSearchLimits& limits, const CurveSearchContext& context);

}  // namespace uncertainty_identification
