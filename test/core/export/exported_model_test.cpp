// The numbers that all exports share.
#include "export/exported_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "support/export_setup.h"
#include "support/mentions.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using test::anyMentions;
using test::exportedAs;

/// num/den at one frequency, evaluated as powers of z.
std::complex<double> valueOf(const ExportedSystems& systems, Index row, double angle) {
  const std::complex<double> z = std::polar(1.0, angle);
  std::complex<double> num = 0, den = 0;
  for (Index k = 0; k < systems.num.cols(); ++k) {
    num = num * z + systems.num(row, k);
    den = den * z + systems.den(row, k);
  }
  return num / den;
}

void expectResponses(const ExportedSystems& systems, const ExportedModel& model) {
  ASSERT_EQ(systems.response.cols(), 500);
  ASSERT_EQ(systems.response.rows(), systems.num.rows());
  EXPECT_EQ(systems.num.cols(), systems.den.cols());
  for (Index i = 0; i < systems.num.rows(); ++i) {
    EXPECT_EQ(systems.den(i, 0), 1);
    for (Index k = 0; k < model.omega.size(); ++k) {
      const std::complex<double> expected = systems.response(i, k);
      ASSERT_LT(std::abs(valueOf(systems, i, model.omega[k] * model.sample_time) - expected),
                1e-9 * std::abs(expected) + 1e-15)
          << i << " at " << model.omega[k];
    }
  }
}

TEST(ExportedModel, PowersOfZHoldTheDelay) {
  const ExportedModel model = exportedAs("motor", test::delayedResult());
  EXPECT_EQ(model.name, "motor");
  EXPECT_EQ(model.delay, 4);
  Eigen::RowVectorXd num(6), den(6);
  num << 0, 0, 0, 0, 0.5, 0.3;
  den << 1, -1.2, 0.5, 0, 0, 0;
  EXPECT_EQ(model.plant.num, num);
  EXPECT_EQ(model.plant.den, den);
  EXPECT_EQ(model.noise.num, Eigen::RowVector3d(1, 0.3, 0));
  EXPECT_EQ(model.noise.den, Eigen::RowVector3d(1, -0.7, 0.2));
  EXPECT_EQ(model.sample_time, 0.1);
  EXPECT_EQ(model.noise_variance, 0.1);
}

TEST(ExportedModel, EverySystemHasTheResponsesOfTheLibrary) {
  for (const Result& result : {test::delayedResult(), test::laguerreResult()}) {
    const ExportedModel model = exportedAs("m", result);
    expectResponses(model.plant, model);
    expectResponses(model.noise, model);
    ASSERT_TRUE(model.samples);
    EXPECT_EQ(model.samples->num.rows(), 5);
    expectResponses(*model.samples, model);
    if (model.weight) expectResponses(*model.weight, model);
  }
}

TEST(ExportedModel, FrequenciesReachToNyquist) {
  const ExportedModel model = exportedAs("m", test::bareResult());
  ASSERT_EQ(model.omega.size(), 500);
  EXPECT_NEAR(model.omega[499], M_PI / 0.1, 1e-12);
  EXPECT_LT(model.omega[0], 0.01 * model.omega[499]);
}

TEST(ExportedModel, BandsAndWeightAreThoseOfTheResult) {
  const Result result = test::delayedResult();
  const ExportedModel model = exportedAs("m", result);
  ASSERT_TRUE(model.bands);
  const FrequencyBounds& frequency = result.bounds->frequency;
  EXPECT_EQ(model.bands->omega, frequency.omega);
  EXPECT_EQ(model.bands->levels.size(), static_cast<Index>(result.bounds->levels.size()));
  const Band& band = frequency.magnitude_bands.total.pointwise[1];
  EXPECT_EQ(model.bands->magnitude_lower.row(1), band.lower.transpose());
  EXPECT_EQ(model.bands->magnitude_upper.row(1), band.upper.transpose());
  EXPECT_EQ(model.bands->phase_lower.row(0),
            frequency.phase_bands.total.pointwise[0].lower.transpose());
  EXPECT_EQ(model.bands->phase_upper.row(0),
            frequency.phase_bands.total.pointwise[0].upper.transpose());
  EXPECT_EQ(model.bands->relative_error_upper.row(2),
            frequency.relative_error.total.pointwise[2].upper.transpose());
  ASSERT_TRUE(model.weight);
  EXPECT_EQ(model.weight->num.row(0), result.bounds->weight->num.transpose());
  EXPECT_EQ(model.weight_level, result.bounds->weight->level);
  EXPECT_TRUE(model.missing.empty());
}

TEST(ExportedModel, BandsWithoutEstimationErrorsAreThoseOfTheMixture) {
  Result result = test::delayedResult();
  result.estimate.joint_covariance.resize(0, 0);
  result = test::withBounds(result.estimate);
  const ExportedModel model = exportedAs("m", result);
  ASSERT_TRUE(model.bands);
  EXPECT_EQ(model.bands->magnitude_upper.row(0),
            result.bounds->frequency.magnitude_bands.mixture.pointwise[0].upper.transpose());
  EXPECT_FALSE(model.samples_hold_estimation_errors);
  EXPECT_TRUE(model.samples);
}

TEST(ExportedModel, PlantsDrawnAreThoseOfTheSeed) {
  const Result result = test::delayedResult();
  const ExportedModel first = exportedModel(result, "m", 7, 3);
  EXPECT_EQ(first.samples_seed, 3u);
  EXPECT_TRUE(first.samples_hold_estimation_errors);
  EXPECT_EQ(first.samples->num, exportedModel(result, "m", 7, 3).samples->num);
  EXPECT_NE(first.samples->num, exportedModel(result, "m", 7, 4).samples->num);
  const PlantSamples drawn = PlantDistribution(result.estimate).draw(7, Uncertainty::total, 3);
  EXPECT_EQ(first.samples->num.rightCols(3), transferFunctions(drawn).num);
}

TEST(ExportedModel, SaysWhatAResultDoesNotHold) {
  const ExportedModel bare = exportedAs("m", test::bareResult());
  EXPECT_FALSE(bare.samples || bare.weight || bare.bands);
  EXPECT_TRUE(anyMentions(bare.missing, "bands and weight: the result holds no bounds"));
  EXPECT_TRUE(anyMentions(bare.missing, "neither an error model nor estimation errors"));

  Result extended = test::laguerreResult();
  extended.estimate.effects.resize(2);
  EXPECT_TRUE(anyMentions(exportedAs("m", extended).missing, "without the 2 effects"));

  Result unstable = test::laguerreResult();
  unstable.estimate.nominal_model.a = Eigen::Vector2d(-2.1, 1.1);
  const ExportedModel of_unstable = exportedAs("m", unstable);
  EXPECT_FALSE(of_unstable.samples);
  EXPECT_TRUE(anyMentions(of_unstable.missing, "plants drawn: the nominal model is not stable"));

  Result without_weight = test::delayedResult();
  without_weight.bounds->weight.reset();
  EXPECT_TRUE(
      anyMentions(exportedAs("m", without_weight).missing, "weight: the result holds none"));

  for (const VectorXd& den :
       {VectorXd(0), VectorXd(Eigen::Vector2d(2, 1)), VectorXd(Eigen::Vector2d(1, std::nan("")))}) {
    Result damaged = test::delayedResult();
    damaged.bounds->weight->den = den;
    const ExportedModel of_damaged = exportedAs("m", damaged);
    EXPECT_FALSE(of_damaged.weight);
    EXPECT_TRUE(anyMentions(of_damaged.missing, "weight: the result's is no transfer function"));
  }

  Result empty;
  EXPECT_THROW(exportedAs("m", empty), DataError);
}

/// By the difference equations, written out.
TEST(ExportedModel, ReferenceSignalsFollowTheModel) {
  const ReferenceSignals signals = exportedAs("m", test::delayedResult()).reference;
  ASSERT_EQ(signals.u.size(), 304);
  const auto at = [](const VectorXd& values, Index t) { return t < 0 ? 0.0 : values[t]; };
  const auto input = [&](Index t) { return t < 0 ? 0.0 : signals.u[t] - 0.25; };
  VectorXd y(304), w(304);
  for (Index t = 0; t < 304; ++t) {
    y[t] = 1.2 * at(y, t - 1) - 0.5 * at(y, t - 2) + 0.5 * input(t - 4) + 0.3 * input(t - 5);
    w[t] = at(signals.residual, t) - 0.7 * at(signals.residual, t - 1) +
           0.2 * at(signals.residual, t - 2) - 0.3 * at(w, t - 1);
  }
  EXPECT_LT((signals.y.array() - 3.5 - y.array()).abs().maxCoeff(), 1e-13);
  EXPECT_LT((signals.innovation - w).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_GT(signals.u.cwiseAbs().maxCoeff(), 0.9);
}

TEST(ExportedModel, TellsWhereItComesFrom) {
  Result result = test::delayedResult();
  result.origin.date = "2026-03-14 15:09";
  result.physical.sentence = "A \"plant\" */ with gain 2.\n";
  const ExportedModel model = exportedAs("m", result);
  EXPECT_TRUE(anyMentions(model.about, "uncertainty_identification 1.2.3, data fingerprint 0123"));
  EXPECT_TRUE(anyMentions(model.about, "2026-03-14 15:09 UTC"));
  EXPECT_TRUE(anyMentions(model.about, "A ?plant? ?/ with gain 2.?"));
}

TEST(ExportedModel, NamesAreIdentifiers) {
  EXPECT_EQ(identifierText("motor_2"), "motor_2");
  EXPECT_EQ(identifierText("2nd motor.v1"), "model_2nd_motor_v1");
  EXPECT_EQ(identifierText("_x"), "model__x");
  EXPECT_EQ(identifierText(""), "model_");
  EXPECT_EQ(identifierText("\xC3\xA4").substr(0, 6), "model_");
  EXPECT_EQ(identifierText(std::string(100, 'a')).size(), 40u);
}

}  // namespace
}  // namespace uncertainty_identification
