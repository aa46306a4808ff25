// Standard errors of models that were fitted to one record. At the maximum of a single experiment
// its score is zero, so nothing about the errors can be learnt from the scores.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "simulation/simulate.h"
#include "support/core_setup.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

/// A slow first-order plant, 3000 samples of which the noise makes up 2 %.
Truth slowPlant() {
  Truth truth;
  truth.sample_time = 0.02;
  truth.experiments = 1;
  truth.samples = {3000};
  truth.plant.b = test::vectorOf({0.02});
  truth.plant.a = test::vectorOf({-0.98});
  truth.noise.variance = 4e-6;
  return truth;
}

Configuration outputError() {
  Configuration configuration;
  configuration.nominal_model.structure = Structure::output_error;
  configuration.nominal_model.orders_auto = false;
  configuration.error_model.taps = 0;
  configuration.error_model.basis = BasisKind::fir;
  configuration.bounds.frequencies = 0;
  configuration.estimation.threads = 1;
  return configuration;
}

/// Of 200 exact 95 % intervals fewer than 180 hold the truth with probability 0.1 % (binomial
/// tail).
TEST(SingleRecord, IntervalsOf95PercentCoverAsOftenAsTheyShould) {
  constexpr int kRecords = 200, kFewest = 180;
  const std::map<std::string, double> truth{{"b1", 0.02}, {"a1", -0.98}, {"noise_variance", 4e-6}};
  std::map<std::string, int> covered;
  for (std::uint64_t seed = 1; seed <= kRecords; ++seed) {
    const Estimate estimate = Identifier(outputError()).identify(simulate(slowPlant(), seed));
    for (const std::string& warning : estimate.warnings)
      EXPECT_EQ(warning.find("cannot be"), std::string::npos) << seed << ": " << warning;
    std::vector<ParameterEstimate> parameters = estimate.nominal_model.parameters;
    parameters.push_back(estimate.noise_variance);
    for (const ParameterEstimate& parameter : parameters) {
      const double error = std::abs(parameter.value - truth.at(parameter.name));
      covered[parameter.name] += error < 1.96 * parameter.standard_error ? 1 : 0;
    }
  }
  for (const auto& [name, value] : truth) EXPECT_GE(covered[name], kFewest) << name;
}

/// The noise is coloured, and Go is fitted to its simulation as if it were white: robust intervals
/// hold the truth all the same, and decide on the bounds. Of 200 exact intervals fewer than 180
/// hold it with a probability of 0.1 %; the plain ones are three times too short.
TEST(SingleRecord, RobustIntervalsHoldInColouredNoise) {
  constexpr int kRecords = 200, kFewest = 180;
  Truth truth = slowPlant();
  truth.plant.b = test::vectorOf({0.2});
  truth.plant.a = test::vectorOf({-0.8});
  truth.noise.d = test::vectorOf({-0.95});
  truth.noise.variance = 1e-3;
  int plain = 0, robust = 0, joint = 0;
  for (std::uint64_t seed = 1; seed <= kRecords; ++seed) {
    Configuration configuration = outputError();
    configuration.nominal_model.fit = PlantFit::simulation;
    const Estimate estimate = Identifier(configuration).identify(simulate(truth, seed));
    const ParameterEstimate& a1 = estimate.nominal_model.parameters[1];
    ASSERT_EQ(a1.name, "a1");
    const double error = std::abs(a1.value + 0.8);
    plain += error < 1.96 * a1.standard_error ? 1 : 0;
    robust += error < 1.96 * a1.robust_standard_error ? 1 : 0;
    // The joint covariance is that of the inverse hyperbolic tangent of a1.
    const double of_joint = std::sqrt(estimate.joint_covariance(1, 1)) * (1 - 0.8 * 0.8);
    joint += error < 1.96 * of_joint ? 1 : 0;
  }
  EXPECT_LT(plain, 0.9 * kFewest);
  EXPECT_GE(robust, kFewest);
  EXPECT_GE(joint, kFewest);
}

/// The information of a long record is that of its two halves, up to their initial states.
TEST(SingleRecord, ErrorsAreThoseOfItsTwoHalves) {
  const std::vector<Experiment> whole = simulate(slowPlant(), 1);
  std::vector<Experiment> halves(2, whole.front());
  for (const int k : {0, 1}) {
    Experiment& half = halves[static_cast<std::size_t>(k)];
    half.id = std::to_string(k);
    half.u = whole.front().u.segment(1500 * k, 1500);
    half.y = whole.front().y.segment(1500 * k, 1500);
    half.valid.resize(std::min<std::size_t>(half.valid.size(), 1500));
  }
  const Estimate of_whole = Identifier(outputError()).identify(whole);
  const Estimate of_halves = Identifier(outputError()).identify(halves);
  for (const std::size_t k : {0, 1}) {
    const double error = of_halves.nominal_model.parameters[k].standard_error;
    EXPECT_NEAR(of_whole.nominal_model.parameters[k].standard_error, error, 0.15 * error);
  }
}

}  // namespace
}  // namespace uncertainty_identification
