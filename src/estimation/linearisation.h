#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "estimation/likelihood.h"
#include "model/linear_model.h"

namespace uncertainty_identification {

/// A model linearised about a point for each experiment.
struct Linearisation {
  std::unique_ptr<LinearModel> model;
  Eigen::MatrixXd points;  ///< one column per experiment
  double move = 0;         ///< largest change of a point in the last step, see nextLinearisation()
};

/// The fixed-point iteration has converged when no point moves by more than this, in standard
/// deviations of the mixture. An optimisation leaves about the same uncertainty in theta, and the
/// error of the linearisation is proportional to the square of the move.
constexpr double kFixedPointTolerance = 1e-3;

/// Whether a fixed-point iteration gets anywhere.
class FixedPointProgress {
 public:
  /// Takes note of a round: of the log-likelihood before it and of the `move` of its points. False
  /// after so many rounds in which the points did not move less than in the round before, and in
  /// between neither the likelihood rose above the highest nor the points moved less than ever, so
  /// that the iteration moves away.
  bool approaches(double log_likelihood, double move);

  /// Whether the points moved less in the last round than in the one before, if there was one.
  bool slowsDown() const { return slows_down_; }

  static constexpr int kPatience = 8;

 private:
  double highest_ = -std::numeric_limits<double>::infinity();
  double least_move_ = std::numeric_limits<double>::infinity();
  double last_move_ = std::numeric_limits<double>::infinity();
  int in_vain_ = 0;
  bool slows_down_ = false;
};

/// How much of each step a fixed-point iteration takes: half as much whenever a step is hardly
/// smaller than the one before and leads elsewhere, because the points then move to and fro.
class StepShare {
 public:
  /// Share of `step` that is to be taken; an empty one is no step.
  double of(const Eigen::MatrixXd& step);

  double now() const { return share_; }  ///< the share that was taken last

 private:
  Eigen::MatrixXd last_;
  double share_ = 1;
};

/// One step of the fixed-point iteration: linearises `model` (which is locally linear) about the
/// posterior means of the error parameters at `point`. If the model is not defined there for an
/// experiment, the step from its column of `points` is halved until it is. `move` is the largest
/// step of any experiment before damping, in standard deviations of the mixture. One sweep over the
/// samples.
Linearisation nextLinearisation(const LinearModel& model, const Likelihood& likelihood,
                                const ModelParameters& point, const Eigen::MatrixXd& points,
                                StepShare* share);

/// The model linearised about zero error parameters at `parameters`, with what the data say of each
/// experiment's start. Absent where this is `model` itself: it is linear everywhere, or knows the
/// start.
std::unique_ptr<LinearModel> linearisedAtStart(const LinearModel& model,
                                               const std::vector<Block>& blocks, int experiments,
                                               const Eigen::VectorXd& parameters);

/// Iterates to the fixed point: the model linearised about each experiment's posterior mean at
/// given parameters, starting from the points `from` or, if these are empty, from zero. Absent if
/// the model is linear everywhere. Adds the number of sweeps to `passes`.
std::optional<Linearisation> linearisedAtPosteriorMeans(const LinearModel& model,
                                                        const std::vector<Block>& blocks,
                                                        int experiments, int threads,
                                                        const ModelParameters& point, int* passes,
                                                        const Eigen::MatrixXd& from = {});

/// The points of experiments whose error parameters are `xi`, a column each, with what the data say
/// of their starts.
Eigen::MatrixXd pointsAt(const LinearModel& model, const std::vector<Block>& blocks,
                         const Eigen::VectorXd& parameters, const Eigen::MatrixXd& xi);

/// Log-likelihood of the experiments under `likelihood`'s model, which is linearised about
/// `points`, less what the linearisation claims beyond them [nats]: for each experiment half the
/// squared distance of its posterior mean from its point, in posterior covariances. Nothing at the
/// fixed point. The difference is large where no point converged, or where the model is not defined
/// at the posterior mean, as beyond the shortest dead time: there the linear model, not the plant,
/// follows the data. `points` is empty for a model that is linear everywhere. One sweep.
double logLikelihoodAtPoints(const LinearModel& model, const Likelihood& likelihood,
                             const ModelParameters& point, const Eigen::MatrixXd& points);

}  // namespace uncertainty_identification
