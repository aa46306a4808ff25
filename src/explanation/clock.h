#pragma once

#include "fit.h"

/// Clock shifts of experiments (exp_clock), which are points that a model is linearised about.
namespace uncertainty_identification {

bool hasClock(const ExtendedModel& model);

/// Which of `columns` random signals the clock shift is the coefficient of.
Eigen::Index clockColumn(const ExtendedModel& model, Eigen::Index columns);

/// Points with the constant shift of each experiment that fits best on a grid: a linearisation
/// about zero would not find shifts of more than half a sample.
Eigen::MatrixXd clockStart(const ExtendedModel& model, const ModelParameters& at,
                           const FitData& data);

}  // namespace uncertainty_identification
