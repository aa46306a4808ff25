#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// A nominal plant identified without one fold of the experiments.
struct FoldModel {
  int delay = 1;         ///< [samples]
  Eigen::VectorXd b, a;  ///< Go = q^-delay B/A
  double offset = 0;     ///< common offset, at the side of estimation.offset_side
};

/// Prediction intervals for the output of a new experiment under its input, that hold whatever the
/// distribution of plants and noise, if the experiments are exchangeable: jackknife+ (each
/// experiment a fold) and CV+ (Barber, Candes, Ramdas, Tibshirani 2021). Experiment r's score is
/// the largest error of its simulation by the model identified without it, max_t |y_r(t) -
/// ysim(t)|, so an interval holds at all times at once. Valid for what is observed, not for the
/// plant's latent response.
struct PredictionCalibration {
  std::string method;          ///< "jackknife+" or "cv+"
  std::vector<double> levels;  ///< 1 - alpha: the share covered in practice
  /// What is guaranteed: 1 - 2 alpha for jackknife+; for CV+ less
  /// min(2 (1 - 1/K)/(M/K + 1), (1 - K/M)/(K + 1)), at least 0.
  std::vector<double> guaranteed;
  std::vector<double> radius;  ///< [unit of y] score that a share 1 - alpha of experiments stays
                               ///< below; infinite where M is too small for the level
  std::vector<double> model_radius;  ///< [unit of y] the same as the identified model has it
  std::vector<FoldModel> folds;
  std::vector<int> fold;              ///< of each experiment used
  std::vector<double> scores;         ///< [unit of y] of each experiment used
  std::vector<std::string> warnings;  ///< e.g. that the model and the scores disagree
};

/// Share of coverage that `experiments` in `folds` guarantee at a level.
double guaranteedCoverage(double level, int experiments, int folds);

/// Fills levels, guaranteed and radius from folds and scores, and says where the model's radii and
/// the scores disagree (two-sided binomial test at 1 %).
void calibrate(const std::vector<double>& levels, PredictionCalibration* calibration);

/// max_t |y(t) - ysim(t)| of each experiment under a plant.
std::vector<double> predictionScores(const FoldModel& plant, const EstimationOptions& options,
                                     const std::vector<Experiment>& experiments);

/// Scores that the identified model expects of these inputs, ascending: outputs simulated with
/// plants drawn from its distribution, its noise, from rest.
std::vector<double> expectedScores(const Estimate& estimate,
                                   const std::vector<Experiment>& experiments);

/// Limits of the output at each sample.
struct PredictionInterval {
  Eigen::VectorXd lower, upper;  ///< [unit of y]; infinite where M is too small for the level
};

/// Interval for the output of an experiment under its input. Its own output may be empty; it is
/// used only where `options` estimate an initial state or an experiment's own offset, and only its
/// first samples are. Throws ConfigurationError for a level that was not calibrated.
PredictionInterval predictionInterval(const PredictionCalibration& calibration, double level,
                                      const EstimationOptions& options,
                                      const Experiment& experiment);

}  // namespace uncertainty_identification
