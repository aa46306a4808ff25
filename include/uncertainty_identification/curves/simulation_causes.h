#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

/// What the free simulation of a linear model gets wrong, as curves at places of the simulation.
namespace uncertainty_identification {

/// A curve in the units of the data. At the input and the sensor it is the whole characteristic;
/// elsewhere what it adds to the linear plant.
struct CurvePicture {
  std::string of;    ///< what goes in: "input", "output", "change of the output per sample", ...
  std::string unit;  ///< of the values: "input", "output", or "1" for a factor
  std::vector<double> signal;              ///< points within the data, rising
  std::vector<double> value;               ///< at the points
  std::vector<double> lower_90, upper_90;  ///< band, pointwise, experiments being independent
};

/// A number that belongs to a shape, such as the half width of a dead zone.
struct ShapeValue {
  std::string name;
  double value = 0;
  double standard_error = 0;  ///< robust: experiments, or windows of few ones, are independent
};

/// A cause's place and shape, for machines.
struct PlaceAndShape {
  std::string name;   ///< of the cause, such as "act_deadzone"
  std::string place;  ///< "input", "position", "rate", "sensor", "play", ... (docs/explanation.md)
  std::string shape;  ///< "dead_zone", "coulomb", ...; "curve": none of the shapes fits as well
  std::string covariate;  ///< name, of places that read one
};

/// A cause that the free simulation shows.
struct SimulationCause {
  PlaceAndShape what;
  std::string description;  ///< in words
  std::string advice;       ///< what to check, or to record next
  std::vector<ShapeValue> values;
  CurvePicture curve;                    ///< empty for dead time, play and rate limits
  std::vector<PlaceAndShape> ties;       ///< explain the data as well
  double fit_before = 0, fit_after = 0;  ///< [%] of held-out windows, without and with this cause
};

/// A held-out window, measured and simulated.
struct SimulatedWindow {
  std::string experiment;
  double start = 0, sample_time = 0;  ///< [s]
  Eigen::VectorXd measured, before, after;
};

/// The result of searching the free simulation.
struct SimulationCauses {
  std::string preparation;  ///< what was done with the records, in a sentence; empty: not searched
  std::string skipped;  ///< why no curves were looked for, or not at all places; empty: they were
  int order = 0;        ///< of the linear plant without causes, and without a lasting oscillation
  /// [Hz] of an oscillation of that plant that no damping ends within the records: of hum, or of
  /// another line in the noise, not of a machine; 0: none.
  double lasting_oscillation = 0;
  bool own_levels = false;  ///< the output of each window is counted from a level of its own
  std::vector<SimulationCause> causes;
  std::string refused;  ///< what simulates better but does not predict better, and why it is not
                        ///< named, in a sentence; empty: nothing
  /// What the first cause that a search in windows of another length did not find may be called:
  /// its name, that of the shape nearest to it, and those of its ties. Not saved.
  std::vector<std::string> withheld;
  /// Of simulating without causes: rms of held-out windows over that of the windows fitted to; NaN:
  /// not searched.
  double held_out_error_ratio = std::numeric_limits<double>::quiet_NaN();
  /// [%] of held-out windows, in free simulation, without causes and with all; NaN: not searched.
  double fit_before = std::numeric_limits<double>::quiet_NaN();
  double fit_after = std::numeric_limits<double>::quiet_NaN();
  /// Of the squared error that is left with all causes, the share that its own past does not
  /// predict: noise of the sensor, which no cause can take away. NaN: not measured.
  double unpredictable_share = std::numeric_limits<double>::quiet_NaN();
  std::string difference;  ///< how a held-out record that is simulated badly differs from those
                           ///< fitted to, in a sentence; empty: it does not, or not by one number
  std::vector<SimulatedWindow> pictures;  ///< the median and the worst window
  bool ended_early = false;               ///< the time limit ended the search
  double seconds = 0;
};

}  // namespace uncertainty_identification
