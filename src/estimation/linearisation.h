#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "estimation/likelihood.h"
#include "model/linear_model.h"

namespace uncertainty_identification {

/// Points that a model is linearised about, one for each experiment.
struct Linearisation {
  std::unique_ptr<LinearModel> model;  ///< null where the model is linear everywhere
  Eigen::MatrixXd points;              ///< n x M
  double move = 0;                     ///< of the last step, as of nextLinearisation()
};

/// Points that move less stand still: a climb leaves theta itself uncertain by about as much, and
/// what a move leaves out of the linearisation goes with its square.
constexpr double kStandingStill = 1e-3;

/// One step: `model` (locally linear) about the posterior means of the error parameters, or, for
/// experiments where it is not defined there, as far on the way to them as it is. The move is the
/// largest of any experiment, in standard deviations of the mixture. One sweep.
Linearisation nextLinearisation(const LinearModel& model, const Likelihood& likelihood,
                                const ModelParameters& at, const Eigen::MatrixXd& points);

/// The model about each experiment's posterior mean at given parameters, found by iteration from
/// zero. Adds its sweeps to `passes`.
Linearisation linearisedAtPosteriorMeans(const LinearModel& model, const std::vector<Block>& blocks,
                                         int experiments, int threads, const ModelParameters& at,
                                         int* passes);

}  // namespace uncertainty_identification
