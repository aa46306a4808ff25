#pragma once

#include <optional>
#include <string>
#include <vector>

#include "uncertainty_identification/own_simulation/simulation.h"

namespace uncertainty_identification {

/// A curve before or behind a simulation: linear between its points, and beyond the ends as in the
/// first and the last piece.
struct OwnCurve {
  /// What goes in: "input", "output", "time" (0 to 1 over a run), or the name of a covariate.
  /// Curves of input and output replace it by the value; others multiply the input by the value.
  std::string of;
  std::vector<double> signal;  ///< rising
  std::vector<double> value;   ///< at the points
};

/// The simulation with all that it was found to lack, in the order in which it acts:
///
///     u -> curve of input, time or covariate -> simulation with `parameters` -> (+ added filter)
///       -> curve of output -> delay -> (1 + lead s) / (1 + lag s) -> gain -> + offset
///       -> + c e^(-t / transient) -> y
///
/// with a c of its own for each run.
struct OwnExtension {
  double sample_time = 0;                       ///< [s] of the data, and of the filters
  std::vector<SimulationParameter> parameters;  ///< with the measured values
  std::optional<OwnCurve> curve;
  /// Of a simulation that is linear: the whole of it, as it was given and with `parameters`. Of one
  /// without parameters: of a linear model of it, whose change, measured u - yours u, is added to
  /// its output. Otherwise absent.
  std::optional<SampledFilter> yours, measured;
  double delay = 0;          ///< [s]; negative: earlier
  double lead = 0, lag = 0;  ///< [s]
  double gain = 1;
  double offset = 0;     ///< [unit of y]
  double transient = 0;  ///< [s]; 0: there is none
};

}  // namespace uncertainty_identification
