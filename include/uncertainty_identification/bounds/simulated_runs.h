#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "uncertainty_identification/bounds/prediction_calibration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// The measured output of an experiment and its free simulation by the nominal model, to be drawn.
struct SimulatedRun {
  std::string id;
  std::string rank;         ///< "best", "median" or "worst" of its set, by the simulation fit
  bool validation = false;  ///< whether the model was not fitted to it
  double fit_percent = 0;   ///< 100 (1 - |y - ysim|/|y - mean y|) over all its samples
  double time_step = 0;     ///< [s] between the points
  /// At most 300 points; NaN where y was not measured. Longer experiments are cut into intervals,
  /// each drawn as its least and its largest value, so that no peak is lost.
  Eigen::VectorXd measured{}, simulated{};
  /// Limits of the prediction interval; empty where none was calibrated or it is not finite.
  Eigen::VectorXd lower{}, upper{};
  double level = 0;  ///< of this interval
};

/// The best, the median and the worst of the experiments that the estimate used, and of the
/// validation experiments. Fewer where there are fewer. `calibration` may be null.
std::vector<SimulatedRun> simulatedRuns(const Estimate& estimate,
                                        const PredictionCalibration* calibration,
                                        const std::vector<Experiment>& training,
                                        const std::vector<Experiment>& validation);

}  // namespace uncertainty_identification
