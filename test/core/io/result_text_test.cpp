#include "io/result_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace uncertainty_identification {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Estimate example() {
  Estimate estimate;
  estimate.experiment_count = 100;
  estimate.sample_count = 10000;
  NominalModelEstimate& nominal = estimate.nominal_model;
  nominal.structure = "box_jenkins";
  nominal.sample_time = 0.01;
  nominal.delay = 2;
  nominal.b = Eigen::Vector2d(1.25, -0.5);
  nominal.a = nominal.c = Eigen::VectorXd::Constant(1, -0.5);
  nominal.parameters = {{"b1", "V", 1.25, 0.01, kNone}};
  estimate.error_model.T = Eigen::Vector2d(1, -1);
  estimate.error_model.mixture = {{0.25, 0.75},
                                  {Eigen::Vector2d(-1, 2), Eigen::Vector2d(1, 3)},
                                  {Eigen::Matrix2d::Identity(), Eigen::Matrix2d::Zero()}};
  estimate.noise_variance.value = 0.125;
  estimate.termination = Termination::converged;
  estimate.message = "the gain left is small";
  return estimate;
}

void expectPart(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "no " << part << " in\n" << text;
}

TEST(ResultText, ShowsModelMixtureAndHowItEnded) {
  const std::string text = resultText(example());
  expectPart(text, "Nominal model: box_jenkins, delay 2 samples, sample time 0.01 s\n");
  expectPart(text, "B =  1.25 q^-2 - 0.5 q^-3\n");
  expectPart(text, "A =  1 - 0.5 q^-1\n");
  expectPart(text, "D =  1\n");
  expectPart(text, "b1              1.25   0.01            -       V\n");
  expectPart(text, "1          0.25    (-1, 2)  [1 0; 0 1]\n");
  expectPart(text, "Noise variance 0.125");
  expectPart(text, "from 100 experiments with 10000 samples\n");
  expectPart(text, "Ended: converged after");
  expectPart(text, "the gain left is small\n");
}

TEST(ResultText, SaysFirstInWordsWhatThePlantIs) {
  Estimate estimate = example();
  estimate.variation = "From experiment to experiment the gain differs by 5 %.";
  const std::string text = resultText(estimate, "First-order plant: gain 8.2.");
  EXPECT_EQ(text.rfind("First-order plant: gain 8.2.\nFrom experiment to experiment", 0), 0u)
      << text;
  EXPECT_EQ(text.find("gain differs"), text.rfind("gain differs"));
  EXPECT_EQ(resultText(example()).rfind("Nominal model:", 0), 0u);
}

TEST(ResultText, ShowsFindingsOnlyWhereThereAreAny) {
  Estimate estimate = example();
  for (const char* heading : {"Candidates", "Validation", "Rejected", "Warning"}) {
    EXPECT_EQ(resultText(estimate).find(heading), std::string::npos) << heading;
  }
  estimate.rejected = {{"run7", "the input is constant; let it change"}};
  estimate.warnings = {"three experiments only"};
  estimate.candidates = {{"orders", "arx nb=1 na=1 delay=1", 3, -5, 20, 87.5, true, -3.5}};
  estimate.validation = {{"v1"}, {91.5}, 90.5, 40.5, -12};
  const std::string text = resultText(estimate);
  expectPart(text, "Rejected run7: the input is constant; let it change\n");
  expectPart(text, "Warning: three experiments only\n");
  expectPart(text,
             "arx nb=1 na=1 delay=1  3           -5              20   87.5              -3.5"
             "              chosen\n");
  expectPart(text, "Validation, log density per experiment -12\n");
  expectPart(text, "v1                                   91.5\n");
  expectPart(text, "all together                         90.5\n");
  expectPart(text, "all together, if each began at rest  40.5\n");
}

TEST(ResultText, TellsHowWellTheModelSimulatesItsOwnData) {
  Estimate estimate = example();
  EXPECT_EQ(resultText(estimate).find("The simulation of"), std::string::npos);
  estimate.simulation_fit_percent = 91.5;
  estimate.error_model.options.basis = BasisKind::fir;
  Mixture& mixture = estimate.error_model.mixture;
  mixture = {{1.0}, {Eigen::VectorXd::Zero(1)}, {Eigen::MatrixXd::Identity(1, 1)}};
  expectPart(resultText(estimate),
             "The simulation of the nominal model fits the experiments that it was identified from "
             "by 91.5 %");
  mixture.means[0][0] = 0.5;
  expectPart(resultText(estimate),
             "The simulation of the mean plant, Go (1 + mean of GDelta), fits the experiments that "
             "it was identified from by 91.5 %");
}

TEST(ResultText, NamesTheParametersThatVary) {
  Estimate varying = example();
  varying.error_model.options.basis = BasisKind::sensitivity;
  varying.error_model.options.sensitivity_order = 2;
  varying.error_model.options.parameters = {"tau1", "gain"};
  EXPECT_NE(resultText(varying).find("sensitivity of tau1, gain and products of two; mixture"),
            std::string::npos);
}

TEST(ResultText, PlainModelHasNoMixture) {
  Estimate estimate = example();
  estimate.error_model = {};
  expectPart(resultText(estimate), "Error model: none\n");
}

TEST(ResultText, AnEstimateThatWasNeverRunSaysSo) {
  expectPart(resultText(Estimate{}), "Ended: not_run after 0 iterations");
}

TEST(ResultText, TheLargestErrorIsThatWherePlantsAreKnown) {
  Bounds bounds;
  bounds.levels = {0.95};
  bounds.frequency.omega = Eigen::Vector2d(1, 50);
  const Band band{0.95, Eigen::Vector2d(0.75, 0), Eigen::Vector2d(1.25, 10)};
  bounds.frequency.magnitude_bands.total = {{band}, {band}, {0}};
  bounds.frequency.relative_error.total = {{band}, {band}, {0}};
  const auto row = [&] {
    const std::string text = boundsText(bounds);
    const std::size_t at = text.find("95 %");
    return text.substr(at, text.find('\n', at) - at);
  };
  expectPart(row(), " 50");
  bounds.frequency.hidden_from = 50;
  expectPart(row(), "1.25");
  EXPECT_EQ(row().find(" 50"), std::string::npos) << row();
  expectPart(boundsText(bounds), "From 50 rad/s on, noise hides what the input causes");
}

}  // namespace
}  // namespace uncertainty_identification
