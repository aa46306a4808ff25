#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// A nominal plant identified from all experiments except one fold.
struct FoldModel {
  int delay = 1;         ///< [samples]
  Eigen::VectorXd b, a;  ///< Go = q^-delay B/A
  double offset = 0;     ///< common offset, added where estimation.offset_side says
};

/// Prediction intervals for the output of a new experiment, given its input. They need no
/// assumption on the distribution of plants and noise except that the experiments are exchangeable.
/// The methods are jackknife+ (every experiment is a fold) and CV+ (Barber, Candes, Ramdas,
/// Tibshirani 2021). The score of experiment r is the largest error of its simulation by the model
/// identified without it, max_t |y_r(t) - ysim(t)|, so an interval holds at all times at once. It
/// is valid for the measured output, not for the plant's output without noise.
struct PredictionCalibration {
  std::string method;          ///< "jackknife+" or "cv+"
  std::vector<double> levels;  ///< 1 - alpha: the coverage to be expected in practice
  /// The coverage that is guaranteed. jackknife+: 1 - 2 alpha. CV+: this minus min(2 (1 - 1/K)/(M/K
  /// + 1), (1 - K/M)/(K + 1)), at least 0, for M experiments and K folds.
  std::vector<double> guaranteed;
  std::vector<double> radius;  ///< [unit of y] score exceeded by a share alpha of experiments;
                               ///< infinite if M is too small
  std::vector<double>
      model_radius;  ///< [unit of y] the same quantile according to the identified model
  std::vector<FoldModel> folds;
  std::vector<int> fold;              ///< the fold of each experiment used
  std::vector<double> scores;         ///< [unit of y] the score of each experiment used
  std::vector<std::string> warnings;  ///< e.g. that model and scores disagree
};

/// The share of coverage guaranteed at a level, for so many `experiments` in so many `folds`.
double guaranteedCoverage(double level, int experiments, int folds);

/// Computes levels, guaranteed and radius from folds and scores. Adds a warning where the model's
/// radii disagree with the scores (two-sided binomial test at 1 %).
void calibrate(const std::vector<double>& levels, PredictionCalibration* calibration);

/// max_t |y(t) - ysim(t)| of each experiment, simulated with `plant`.
std::vector<double> predictionScores(const FoldModel& plant, const EstimationOptions& options,
                                     const std::vector<Experiment>& experiments);

/// The scores to be expected for these inputs according to the identified model, ascending. They
/// come from outputs simulated from rest with plants and noise drawn from the model.
std::vector<double> expectedScores(const Estimate& estimate,
                                   const std::vector<Experiment>& experiments);

/// Limits of the output at each sample.
struct PredictionInterval {
  Eigen::VectorXd lower, upper;  ///< [unit of y]; infinite if M is too small for the level
};

/// The interval for the output of an experiment, given its input. Its own output may be empty: it
/// is used only if `options` estimate an initial state or an offset per experiment, and then only
/// the first samples. Throws ConfigurationError for a level that was not calibrated.
PredictionInterval predictionInterval(const PredictionCalibration& calibration, double level,
                                      const EstimationOptions& options,
                                      const Experiment& experiment);

}  // namespace uncertainty_identification
