#pragma once

#include "explanation/fit.h"

/// Clock shifts of experiments (exp_clock), points that a model is linearised about: where they
/// begin.
namespace uncertainty_identification {

bool hasClock(const ExtendedModel& model);

/// Points with the constant shift of each experiment that fits best on a grid: a linearisation
/// about zero would not find shifts of more than half a sample.
Eigen::MatrixXd clockStart(const ExtendedModel& model, const ModelParameters& at,
                           const FitData& data);

}  // namespace uncertainty_identification
