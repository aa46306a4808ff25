#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "estimation/least_squares_start.h"
#include "model/linear_model.h"

namespace uncertainty_identification {

/// Sizes of the polynomials a model uses, read off at an arbitrary admissible point.
Polynomials sizesOf(const NominalModel& nominal);

/// Go u + offset from rest.
Eigen::VectorXd simulated(const Polynomials& p, double offset, const Eigen::VectorXd& u);

/// Index of the ARX model in leastSquaresModels(), where there is no dead time.
constexpr std::size_t kArx = 1;

/// Least-squares models of Go: pooled by Steiglitz-McBride, pooled as ARX, the median of single
/// experiments and, with an error model, pooled with unknown starts and with an error model of each
/// experiment. With a dead time: pooled by Steiglitz-McBride at several delays, from the measured
/// outputs and from smoothed ones.
std::vector<LeastSquaresModel> leastSquaresModels(const LinearModel& model,
                                                  const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
