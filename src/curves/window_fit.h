#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "curves/curve_model.h"
#include "curves/simulation_data.h"

namespace uncertainty_identification {

/// A model fitted to the free simulation of all windows by least squares, with what leaving each
/// group of windows out would give. All errors are in standard deviations of the output.
struct WindowFit {
  CurveModel model;
  double squared_error = 0;     ///< of all windows, their initial states fitted
  double left_out = 0;          ///< of all windows, each predicted from the others
  Eigen::VectorXd left_out_of;  ///< its parts: groups, or thirds of windows where groups are few
  std::vector<Eigen::VectorXd> residuals;  ///< of each window, 0 where y is missing
  Eigen::VectorXd step;                    ///< of theta, of a linearised fit
  Eigen::MatrixXd covariance;              ///< of theta, robust: groups are the independent units

  int parameters() const { return model.parameters(); }
};

/// When to stop.
struct FitLimits {
  int iterations = 20;
  double tolerance = 2e-4;         ///< relative fall of the squared error that counts as progress
  std::function<bool()> going_on;  ///< false: stop with what has been reached; may be empty
};

/// Squared error of the free simulation from the model's initial states; huge where it diverges.
double simulationError(const SimulationData& data, const CurveModel& model);

/// Levenberg and Marquardt on the free simulation. The windows' initial states are eliminated.
WindowFit fitFreely(const SimulationData& data, CurveModel model, const FitLimits& limits);

/// theta of a fit without each of these sets of windows, exact for the linearised model.
std::vector<Eigen::VectorXd> thetaWithout(const SimulationData& data, const WindowFit& fit,
                                          const std::vector<std::vector<int>>& windows);

/// One linearised step from the model, whose curves are at zero, without a further simulation.
WindowFit stepLinearly(const SimulationData& data, const CurveModel& model);

/// Whether the plant may have these poles: within the unit circle, a little beyond it where curves
/// are fed back.
bool isSimulable(const CurveModel& model);

}  // namespace uncertainty_identification
