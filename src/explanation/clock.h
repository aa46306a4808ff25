#pragma once

#include "explanation/fit.h"

/// Starts for the clock shifts of experiments (exp_clock), which the model is linearised about.
namespace uncertainty_identification {

/// Whether exp_clock is among the effects of the model.
bool hasClock(const ExtendedModel& model);

/// Points of linearisation in which the shift of each experiment is the best one on a grid, over
/// which it is constant in time. A fixed-point iteration that starts from no shift would not find
/// shifts of more than half a sample.
Eigen::MatrixXd clockStart(const ExtendedModel& model, const ModelParameters& at,
                           const FitData& data);

}  // namespace uncertainty_identification
