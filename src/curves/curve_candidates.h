#pragma once

#include <functional>
#include <vector>

#include "curves/naming.h"
#include "curves/plant_orders.h"
#include "curves/screening_places.h"

namespace uncertainty_identification {

enum class CandidateKind { order, direct, delay, curve };

/// A change of the model that competes in a round.
struct CurveCandidate {
  CandidateKind kind = CandidateKind::curve;
  PlaceOf place;
  WindowFit fit;
  Naming naming;                 ///< of curves
  Eigen::VectorXd unseen;        ///< unseenErrors() of fit
  Eigen::VectorXd named_unseen;  ///< unseenErrors() of naming.fit
  Eigen::VectorXd beyond;        ///< its unseenBeyondDifferences(); may be empty
  bool is_named = false;         ///< fit is naming.fit

  /// The larger plant, or the named curve.
  const WindowFit& accepted() const { return kind == CandidateKind::curve ? naming.fit : fit; }
};

/// How many candidates there are.
struct CandidateLimits {
  int max_order = 4;  ///< of the plant; 3 once the model has a curve
  int places = 4;  ///< how many of the screened places are fitted fully; the usual ones always are
  std::function<bool(Place)> excluded;  ///< places that are not tried; may be empty
};

/// Larger plants, dead time and curves on top of a model, the best first.
std::vector<CurveCandidate> candidatesFor(const SimulationData& data, const SimulationData& held,
                                          const WindowFit& now, const LinearPlants& linear,
                                          const CandidateLimits& limits,
                                          const CurveSearchContext& context);

/// The curves in the order of their errors beyond what differs between experiments, which `unseen`
/// gives of a fit. Only those with which unseen windows are simulated better also as they are;
/// nothing where the windows do not show what experiments differ by.
std::vector<CurveCandidate> curvesBeyondDifferences(
    std::vector<CurveCandidate> all, const Eigen::VectorXd& now, WorkerPool* pool,
    const std::function<Eigen::VectorXd(const WindowFit&)>& unseen);

/// The first curve of each place that none of those `tied` is at.
std::vector<CurveCandidate> ofOtherPlaces(const std::vector<CurveCandidate>& all,
                                          const std::vector<CurveCandidate>& tied);

/// The curves that unseen windows cannot tell from the first candidate, which is a curve. The first
/// of them is the one to be named. `now` are the unseen errors without any of them.
std::vector<CurveCandidate> tiedWithFirst(const std::vector<CurveCandidate>& all,
                                          const Eigen::VectorXd& now);

}  // namespace uncertainty_identification
