#pragma once

#include <string>
#include <vector>

#include "curves/curve_candidates.h"

namespace uncertainty_identification {

/// Another place or shape that explains the data as well.
struct TiedCurve {
  PlaceOf place;
  std::string shape;
};

/// A cause that the search accepted, in the order in which they were found.
struct FoundCurve {
  PlaceOf place;
  std::string shape;    ///< of the curve when it was found
  std::string nearest;  ///< of a free curve
  double nearest_share = 0;
  std::vector<TiedCurve> ties;
  double left_out_gain = 0;  ///< share of the squared error that goes when windows are left out
  double t = 0;              ///< paired, over windows
  double held_before = 0, held_after = 0;  ///< squared error of all held-out windows
};

/// Adds another place or shape to the cause's ties, unless it is among them or they are many.
void addTie(const TiedCurve& tie, FoundCurve* cause);

/// Adds the shapes of the cause's curve that are as good as the chosen one.
void addTies(const Naming& naming, FoundCurve* cause);

/// Whether the cause, or one of its ties, is at the place.
bool mayBeAt(const FoundCurve& cause, Place place);

/// Adds another place in front of other ties, unless the cause or one of them is there.
void addPlaceTie(const TiedCurve& tie, FoundCurve* cause);

/// The cause to be named, which is the first of those tied, with the others as its ties. `now` is
/// the fit without it.
FoundCurve foundCurve(const std::vector<CurveCandidate>& tied, const WindowFit& now);

/// What a cause may be called: its name, that of the shape nearest to a free curve, and those of
/// its ties. Nothing of a covariate's, as names do not tell which it is.
std::vector<std::string> possibleNames(const FoundCurve& cause);

/// How many of the first causes are also among `others`: at the same place, as a tie or with one.
std::size_t countConfirmed(const std::vector<FoundCurve>& causes,
                           const std::vector<FoundCurve>& others);

}  // namespace uncertainty_identification
