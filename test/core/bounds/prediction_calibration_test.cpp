#include "uncertainty_identification/bounds/prediction_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/core_setup.h"
#include "support/example1.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

/// Heavy tails that a mixture of two components cannot follow: xi scaled by a Cauchy draw.
std::vector<Experiment> heavyTailed(int count, std::uint64_t seed) {
  Truth truth = loadTruth(std::string(PROJECT_FOLDER) + "/config/example1_truth.yaml");
  truth.experiments = 1;
  std::mt19937_64 random(seed);
  std::cauchy_distribution<double> cauchy(0, 0.3);
  std::vector<Experiment> all;
  for (int r = 0; r < count; ++r) {
    truth.error_model.mixture = {{1.0},
                                 {Eigen::VectorXd::Constant(1, cauchy(random))},
                                 {Eigen::MatrixXd::Constant(1, 1, 1e-6)}};
    all.push_back(simulate(truth, random()).front());
    all.back().id = "heavy" + std::to_string(r);
  }
  return all;
}

Configuration configuration(int folds, int components) {
  Configuration configuration = example1Configuration();
  configuration.bounds.levels = {0.5, 0.9};
  configuration.bounds.folds = folds;
  configuration.error_model.components = components;
  return configuration;
}

double shareInside(const PredictionCalibration& calibration, double level,
                   const EstimationOptions& options, const std::vector<Experiment>& fresh) {
  int inside = 0;
  for (const Experiment& experiment : fresh) {
    const PredictionInterval interval = predictionInterval(calibration, level, options, experiment);
    inside += (experiment.y.array() <= interval.upper.array()).all() &&
              (experiment.y.array() >= interval.lower.array()).all();
  }
  return inside / static_cast<double>(fresh.size());
}

TEST(PredictionCalibration, GuaranteesAsTheTheoremsSay) {
  EXPECT_DOUBLE_EQ(guaranteedCoverage(0.95, 100, 100), 0.9);              // jackknife+
  EXPECT_NEAR(guaranteedCoverage(0.95, 100, 10), 0.9 - 0.9 / 11, 1e-12);  // CV+
  EXPECT_EQ(guaranteedCoverage(0.5, 100, 100), 0);
}

/// If the mixture is wrong, the calibrated interval is still valid, and a warning says that the
/// model's interval is not.
TEST(PredictionCalibration, HoldsWhereTheMixtureIsWrong) {
  const Identifier identifier(configuration(50, 1));
  const std::vector<Experiment> experiments = heavyTailed(50, 1);
  const Estimate estimate = identifier.identify(experiments);
  const PredictionCalibration calibration = identifier.calibrate(estimate, experiments);
  EXPECT_EQ(calibration.method, "jackknife+");
  ASSERT_EQ(calibration.warnings.size(), 1u);
  EXPECT_NE(calibration.warnings[0].find("trust the calibrated radius"), std::string::npos);
  const std::vector<Experiment> fresh = heavyTailed(400, 2);
  const double share = shareInside(calibration, 0.9, identifier.configuration().estimation, fresh);
  EXPECT_GE(share, calibration.guaranteed[1]);  // 0.8
  EXPECT_NEAR(share, 0.9, 3 * std::sqrt(0.09 * (1.0 / 50 + 1.0 / 400)));
}

TEST(PredictionCalibration, AgreesWithAModelThatIsTrue) {
  const Identifier identifier(configuration(10, 2));
  const std::vector<Experiment> experiments = example1Experiments(60);
  const Estimate estimate = identifier.identify(experiments);
  const PredictionCalibration calibration = identifier.calibrate(estimate, experiments);
  EXPECT_EQ(calibration.method, "cv+");
  EXPECT_EQ(calibration.folds.size(), 10u);
  EXPECT_EQ(calibration.scores.size(), 60u);
  EXPECT_TRUE(calibration.warnings.empty()) << calibration.warnings[0];
  EXPECT_NEAR(calibration.radius[0] / calibration.model_radius[0], 1, 0.3);
}

TEST(PredictionCalibration, IsInfiniteWhereExperimentsAreTooFew) {
  const Identifier identifier(configuration(8, 1));
  const std::vector<Experiment> experiments = example1Experiments(8);
  const Estimate estimate = identifier.identify(experiments);
  const PredictionCalibration calibration = identifier.calibrate(estimate, experiments);
  EXPECT_TRUE(std::isfinite(calibration.radius[0]));
  EXPECT_TRUE(std::isinf(calibration.radius[1]));  // 90 % of 9 is more than 8
  const PredictionInterval interval =
      predictionInterval(calibration, 0.9, identifier.configuration().estimation, experiments[0]);
  EXPECT_TRUE(std::isinf(interval.upper[5]));
  EXPECT_LT(interval.lower[5], 0);
}

TEST(PredictionCalibration, NamesTheLevelsItHas) {
  PredictionCalibration calibration;
  calibration.levels = {0.5};
  EXPECT_THROW(predictionInterval(calibration, 0.9, {}, {}), ConfigurationError);
}

TEST(PredictionCalibration, ScoresWhatIsNotRejected) {
  std::vector<Experiment> experiments = example1Experiments(12);
  experiments[3].y[5] = std::nan("");  // rejected by the checks, or masked
  experiments[3].valid.clear();
  const Identifier identifier(configuration(4, 1));
  const Estimate estimate = identifier.identify(experiments);
  const PredictionCalibration calibration = identifier.calibrate(estimate, experiments);
  EXPECT_EQ(calibration.scores.size(), estimate.experiments.size());
}

/// Only the experiments of the first fold have an input that varies. Without them nothing can be
/// fitted.
TEST(PredictionCalibration, LeavesOutAFoldThatCannotBeFitted) {
  constexpr int kFolds = 4;
  const Identifier identifier(configuration(kFolds, 1));
  std::vector<Experiment> experiments = example1Experiments(12);
  const Estimate estimate = identifier.identify(experiments);
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    if (r % kFolds != 0) experiments[r].u.setZero();
  }
  const PredictionCalibration calibration = identifier.calibrate(estimate, experiments);
  EXPECT_EQ(calibration.folds.size(), 3u);
  EXPECT_EQ(calibration.scores.size(), 9u);
  EXPECT_EQ(calibration.fold, (std::vector<int>{0, 1, 2, 0, 1, 2, 0, 1, 2}));
  ASSERT_FALSE(calibration.warnings.empty());
  EXPECT_NE(calibration.warnings[0].find("fold 1 of 4"), std::string::npos)
      << calibration.warnings[0];
  for (std::size_t r = 0; r < experiments.size(); r += kFolds) experiments[r].u.setZero();
  EXPECT_THROW(identifier.calibrate(estimate, experiments), DataError);
}

TEST(PredictionCalibration, CanBeCancelled) {
  const Identifier identifier(configuration(4, 1));
  const std::vector<Experiment> experiments = example1Experiments(12);
  const Estimate estimate = identifier.identify(experiments);
  int calls = 0;
  const PredictionCalibration calibration = identifier.calibrate(
      estimate, experiments, [&calls](const Progress&) { return ++calls < 3; });
  EXPECT_TRUE(calibration.folds.empty());
}

}  // namespace
}  // namespace uncertainty_identification
