#pragma once

#include <functional>
#include <string>
#include <vector>

#include "curves/curve_search.h"
#include "curves/preparation.h"

namespace uncertainty_identification {

/// Samples that are fitted to: enough for a curve, and a bounded time.
constexpr int kMostSamplesOfSearch = 6000;

/// A search for curves in windows of some length.
struct WindowSearch {
  SimulationData data, kept;      ///< windows that are fitted to and those held out
  bool held_out_of_data = false;  ///< there were no records to hold out: every third window is
  CurveSearchResult result;

  double fitOf(double squared_error) const;  ///< of the held-out windows [%]
  double baseError() const;                  ///< squared, of the linear plant in them

  /// Whether the causes may be owed to the choice of windows: the linear plant simulates so well
  /// that little is left to tell causes apart, or the causes leave much.
  bool needsConfirmation() const;

  /// Goes back to the linear plant, as there was no time to confirm the causes.
  void dropCauses();
};

/// Searches windows of `fitted`. Those held out are of `held` or, where this is empty, the last
/// third. `kept` is empty where there are too few.
WindowSearch searchWindows(const std::vector<Experiment>& fitted,
                           const std::vector<Experiment>& held, const WindowPlan& plan,
                           const SignalScales& scales, const CurveSearchLimits& limits,
                           const CurveSearchContext& context);

enum class Purpose { looking, confirming };

/// The search in windows of a plan. A search that confirms what was found may take as much time
/// again as has been used so far.
using WindowSearcher =
    std::function<WindowSearch(const WindowPlan&, const CurveSearchLimits&, Purpose)>;

struct PlannedSearch {
  WindowPlan plan;
  WindowSearch found;
  std::vector<FoundCurve> withheld;  ///< causes that are not confirmed
  std::string refused;               ///< what is said of these; may be empty
};

/// The search in windows of the plan or, where these show nothing and experiments are held out, in
/// longer ones, whose causes have to take away most of the held-out error. Where causes need
/// confirmation, those that are not found again in windows of another length are dropped: all of
/// them where the time is over before this search ends.
PlannedSearch searchInWindows(const WindowPlan& plan, const std::vector<Experiment>& experiments,
                              const CurveSearchLimits& limits, const WindowSearcher& search);

/// The names of causes, separated by commas.
std::string namesOf(const std::vector<FoundCurve>& causes);

}  // namespace uncertainty_identification
