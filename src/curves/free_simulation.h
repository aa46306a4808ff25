#pragma once

#include <Eigen/Core>
#include <vector>

#include "curves/curve_model.h"
#include "curves/simulation_data.h"

namespace uncertainty_identification {

constexpr double kLargestState = 50;  ///< standard deviations at which a diverging state is held

/// The output of a model that sees the input only, and its derivatives.
struct FreeSimulation {
  Eigen::VectorXd y;  ///< T
  /// (P + I) x T, by theta and by the initial values; empty unless asked for. Exact, by forward
  /// sensitivities.
  Eigen::MatrixXd derivatives;
  Eigen::VectorXd rate;  ///< T, change of x from sample to sample in units of rate_scale
};

/// Simulates a window from `initial` (I = model.initialValues() values). `tables` are those of the
/// model's curves.
FreeSimulation simulateFreely(const CurveModel& model, const std::vector<CurveTable>& tables,
                              const SimulationWindow& window, const Eigen::VectorXd& initial,
                              bool with_derivatives);

/// The measured output a sample before the window, by the slope of its first samples.
double valueBefore(const SimulationWindow& window);

/// The tables of all curves at the model's theta; empty ones for widths and limits.
std::vector<CurveTable> tablesOf(const CurveModel& model);

}  // namespace uncertainty_identification
