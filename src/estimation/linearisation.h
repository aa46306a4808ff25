#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "estimation/likelihood.h"
#include "model/linear_model.h"

namespace uncertainty_identification {

/// A model linearised about a point for each experiment.
struct Linearisation {
  std::unique_ptr<LinearModel> model;
  Eigen::MatrixXd points;  ///< columns, one for each experiment
  double move = 0;         ///< of the last step, as of nextLinearisation()
};

/// The fixed-point iteration of linearisations has converged when no point moves by more. An
/// optimisation leaves theta itself uncertain by about as much, and the error of the linearisation
/// goes with the move's square.
constexpr double kFixedPointTolerance = 1e-3;

/// One step of the iteration: `model` (locally linear) about the posterior means of the error
/// parameters at `point`. For an experiment where the model is not defined there, the step from its
/// column of `points` is halved until it is. The move is the largest of any experiment, in standard
/// deviations of the mixture. One sweep.
Linearisation nextLinearisation(const LinearModel& model, const Likelihood& likelihood,
                                const ModelParameters& point, const Eigen::MatrixXd& points);

/// The model about each experiment's posterior mean at given parameters, by the fixed-point
/// iteration from zero; none where the model is linear everywhere. Adds its sweeps to `passes`.
std::optional<Linearisation> linearisedAtPosteriorMeans(const LinearModel& model,
                                                        const std::vector<Block>& blocks,
                                                        int experiments, int threads,
                                                        const ModelParameters& point, int* passes);

}  // namespace uncertainty_identification
