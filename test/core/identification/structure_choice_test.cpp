// The structures that the default configuration compares, their fits, and orders that only the
// residuals show. Data: first- and second-order plants, simulated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "identification/steps.h"
#include "identification/structure_fit.h"
#include "simulation/simulate.h"
#include "support/core_setup.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

using test::vectorOf;

/// Plants of a known model with white output noise, without differences between them.
std::vector<Experiment> simulatedPlants(const Eigen::VectorXd& b, const Eigen::VectorXd& a,
                                        int experiments = 10) {
  Truth truth;
  truth.sample_time = 0.1;
  truth.experiments = experiments;
  truth.samples = {200};
  truth.plant.b = b;
  truth.plant.a = a;
  truth.noise.variance = 1e-3;
  return simulate(truth, 3);
}

class StructureChoice : public testing::Test {
 protected:
  Problem problemOf(const std::vector<Experiment>& experiments, int nb, int na) {
    Configuration configuration;
    NominalModelOptions& nominal = configuration.nominal_model;
    nominal.orders_auto = false;
    nominal.nb = nb;
    nominal.na = na;
    nominal.nc = nominal.nd = 0;
    data_ = checkData(configuration, experiments, &journal_);
    Problem problem{data_, {}, nullptr, configuration, {}, {}};
    problem.configuration = chooseInitialState(configuration, data_, &journal_);
    return problem;
  }

  /// The fit of the nominal model without an error model.
  StructureFit plainFit(const Problem& problem) {
    const std::vector<ErrorStructure> all = errorStructures(problem, nullptr);
    const auto none = std::find_if(all.begin(), all.end(),
                                   [](const auto& each) { return each.description == "none"; });
    return *fitStructure(problem, *none, {}, true, &journal_);
  }

  static std::vector<std::string> descriptions(const std::vector<ErrorStructure>& structures) {
    std::vector<std::string> all;
    for (const ErrorStructure& structure : structures) all.push_back(structure.description);
    return all;
  }

  Journal journal_{ProgressPhases({})};
  CheckedData data_;
};

bool contains(const std::vector<std::string>& all, const std::string& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

TEST_F(StructureChoice, ComparesPhysicalParametersWhereThePolesHaveAContinuousCounterpart) {
  const Problem problem = problemOf(simulatedPlants(vectorOf({0.2}), vectorOf({-0.8})), 1, 1);
  Polynomials plant;
  plant.delay = 1;
  plant.b = vectorOf({0.2});
  plant.a = vectorOf({-0.8});
  const auto physical = descriptions(errorStructures(problem, &plant));
  EXPECT_TRUE(contains(physical, "none"));
  EXPECT_TRUE(contains(physical, "fir, 1 tap, zero_mean"));
  EXPECT_TRUE(contains(physical, "fir, 2 taps, zero_static_gain"));
  EXPECT_FALSE(contains(physical, "fir, 1 tap, zero_static_gain")) << "it leaves nothing free";
  EXPECT_TRUE(contains(physical, "parameter_spread of gain"));
  EXPECT_TRUE(contains(physical, "parameter_spread of gain and tau1"));
  plant.a = vectorOf({0.8});  // a pole that alternates has no time constant
  const auto sampled = descriptions(errorStructures(problem, &plant));
  EXPECT_TRUE(contains(sampled, "parameter_spread of b1 and a1"));
  EXPECT_FALSE(contains(sampled, "parameter_spread of gain"));
}

TEST_F(StructureChoice, ComparesNumeratorsThatVaryWhereTheExperimentsShowTheirCovariance) {
  Polynomials plant;
  plant.delay = 1;
  plant.b = vectorOf({0.1, 0.2, 0.1});
  for (const double pole : {0.8, -0.8}) {  // with and without a time constant
    plant.a = vectorOf({-pole});
    const auto compared = [&](int experiments) {
      const Problem problem = problemOf(simulatedPlants(plant.b, plant.a, experiments), 3, 1);
      return descriptions(errorStructures(problem, &plant));
    };
    EXPECT_TRUE(contains(compared(7), "parameter_spread of b1, b2 and b3"));
    EXPECT_FALSE(contains(compared(6), "parameter_spread of b1, b2 and b3"))
        << "the covariance has six elements";
  }
}

TEST_F(StructureChoice, ComparesOneTapForTwoExperiments) {
  const auto compared = [&](int experiments) {
    const auto plants = simulatedPlants(vectorOf({0.2}), vectorOf({-0.8}), experiments);
    return descriptions(errorStructures(problemOf(plants, 1, 1), nullptr));
  };
  EXPECT_TRUE(contains(compared(8), "fir, 4 taps, zero_mean"));
  EXPECT_FALSE(contains(compared(7), "fir, 4 taps, zero_mean"));
  EXPECT_TRUE(contains(compared(7), "fir, 3 taps, zero_mean"));
  EXPECT_TRUE(contains(compared(2), "fir, 2 taps, zero_static_gain")) << "fewer leave nothing free";
}

/// The zero of a second-order plant may stand for a fraction of a sample.
TEST_F(StructureChoice, ComparesADeadTimeBesideWhatVariesWhereItsOwnVariationIsWorthIt) {
  Polynomials plant;
  plant.delay = 2;
  plant.b = vectorOf({0.1, 0.1});
  plant.a = vectorOf({-1.2, 0.5});
  const Problem problem = problemOf(simulatedPlants(plant.b, plant.a, 4), 2, 2);
  const auto compared = errorStructures(problem, &plant);
  const auto found = std::find_if(compared.begin(), compared.end(), [](const auto& each) {
    return each.description == "parameter_spread of omega1, with a dead time";
  });
  ASSERT_NE(found, compared.end());
  EXPECT_TRUE(found->configuration.nominal_model.dead_time);
  EXPECT_EQ(found->if_better, "parameter_spread of dead_time");
  const auto alone = std::find_if(compared.begin(), compared.end(), [](const auto& each) {
    return each.description == "parameter_spread of dead_time";
  });
  EXPECT_LT(alone - compared.begin(), found - compared.begin()) << "what decides comes first";
}

TEST_F(StructureChoice, SingleStepsDetermineNoMoreThanTwoPoles) {
  std::vector<Experiment> experiments = simulatedPlants(vectorOf({0.2}), vectorOf({-0.8}), 4);
  const auto largestOrder = [&] {
    Problem problem = problemOf(experiments, 1, 1);
    problem.configuration.nominal_model = NominalModelOptions();
    return chooseOrders(problem, &journal_).nominal_model.max_order;
  };
  EXPECT_EQ(largestOrder(), NominalModelOptions().max_order);
  for (Experiment& experiment : experiments) {
    double x = 0;
    for (int t = 0; t < experiment.samples(); ++t) {
      experiment.y[t] += x - experiment.y[t] / 2;
      experiment.u[t] = t < 10 ? 0 : 1;
      x = 0.8 * x + 0.2 * experiment.u[t];
    }
  }
  EXPECT_EQ(largestOrder(), 2);
}

TEST_F(StructureChoice, FewSamplesDetermineFewPoles) {
  const auto largestOrder = [&](std::vector<Experiment> experiments, Eigen::Index samples) {
    for (Experiment& each : experiments) {
      each.u.conservativeResize(samples);
      each.y.conservativeResize(samples);
    }
    Problem problem = problemOf(experiments, 1, 1);
    problem.configuration.nominal_model = NominalModelOptions();
    return chooseOrders(problem, &journal_).nominal_model.max_order;
  };
  const auto one = simulatedPlants(vectorOf({0.2}), vectorOf({-0.8}), 1);
  EXPECT_EQ(largestOrder(one, 200), 5) << "20 samples for each coefficient of A and B";
  EXPECT_EQ(largestOrder(one, 60), 2);
  const auto three = simulatedPlants(vectorOf({0.2}), vectorOf({-0.8}), 3);
  EXPECT_EQ(largestOrder(three, 80), 6);
}

TEST_F(StructureChoice, ComparesNothingButTapsWhereTheBasisIsGiven) {
  Problem problem = problemOf(simulatedPlants(vectorOf({0.2}), vectorOf({-0.8})), 1, 1);
  problem.configuration.error_model = paperErrorModel();
  EXPECT_EQ(descriptions(errorStructures(problem, nullptr)),
            std::vector<std::string>{"fir, 2 taps, zero_static_gain"});
  problem.configuration.error_model.taps = kAutomatic;
  EXPECT_EQ(errorStructures(problem, nullptr).size(),
            static_cast<std::size_t>(problem.configuration.error_model.max_taps) - 1);
}

TEST_F(StructureChoice, RaisesOrdersThatTheResidualsAskFor) {
  const auto experiments = simulatedPlants(vectorOf({0.2, 0.1}), vectorOf({-1.3, 0.4}));
  const Problem problem = problemOf(experiments, 1, 1);
  const StructureFit small = plainFit(problem);
  const StructureFit large = withBetterOrders(problem, small, true, &journal_);
  EXPECT_EQ(large.structure.configuration.nominal_model.na, 2);
  EXPECT_EQ(large.structure.configuration.nominal_model.nb, 2);
  EXPECT_GT(large.log_likelihood, small.log_likelihood + 100);
  EXPECT_EQ(large.parameters, small.parameters + 2);
}

/// Third-order plants whose relative errors have three taps and no static gain, by about their
/// whole size: pooled simulations show no more than two poles.
std::vector<Experiment> plantsThatDifferMuch() {
  Truth truth;
  truth.experiments = 30;
  truth.samples = {200};
  truth.plant.b = vectorOf({0.0188});
  truth.plant.a = vectorOf({-2.253, 1.8227, -0.5133});
  truth.error_model.basis.taps = 3;
  const Eigen::MatrixXd covariance = 0.0225 * Eigen::MatrixXd::Identity(2, 2);
  truth.error_model.mixture = {
      {0.26, 0.28, 0.46},
      {vectorOf({-0.31, 0.92}), vectorOf({-0.07, -0.05}), vectorOf({1.17, 0.51})},
      {covariance, covariance, covariance}};
  truth.noise.variance = 4e-5;
  truth.noise.c = vectorOf({-0.8795});
  truth.noise.d = vectorOf({-0.6629});
  return simulate(truth, 1);
}

// These data are a case in which the search first ends with two poles, as in two of four seeds.
TEST(StructureChoiceAgain, FollowsRaisedOrders) {
  const std::vector<Experiment> experiments = plantsThatDifferMuch();
  const Estimate estimate = Identifier(Configuration()).identify(experiments);
  EXPECT_EQ(estimate.nominal_model.a.size(), 3);
  EXPECT_EQ(estimate.error_model.options.constraint, Constraint::zero_static_gain);
  EXPECT_GE(estimate.error_model.options.taps, 3);
  EXPECT_TRUE(estimate.trust.trusted) << estimate.trust.reasons.front();
}

/// While a hum is not modelled, it hides a fast pole, of which the residuals speak afterwards.
TEST(StructureChoiceAgain, FindsWhatAHumHid) {
  Experiment record;
  record.id = "hum";
  record.sample_time = 0.005;
  record.u = record.y = Eigen::VectorXd::Zero(400);
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  double fast = 0, slow = 0;
  for (int k = 0; k < 400; ++k) {
    record.u[k] = k / 60 % 2 == 0 ? 1 : -1;
    record.y[k] = slow + 0.1 * std::sin(0.9 * k) + 2e-3 * normal(engine);
    slow = 0.85 * slow + 0.15 * fast;
    fast = 0.4 * fast + 0.6 * record.u[k];
  }
  const Estimate estimate = Identifier(Configuration()).identify({record});
  EXPECT_GT(estimate.residual_tests.independence_p_value, 0.01);
}

// More of a plant's parameters that vary look like another pole, so that the model before the last
// one is still compared.
TEST_F(StructureChoice, KeepsTheModelWithFewerPolesBesideTheRaisedOne) {
  const auto experiments = simulatedPlants(vectorOf({0.2, 0.1}), vectorOf({-1.3, 0.4}));
  const std::vector<StructureFit> fits = jointOrders(problemOf(experiments, 1, 1), {}, &journal_);
  ASSERT_EQ(fits.size(), 2u);
  EXPECT_EQ(fits[0].start().polynomials.a.size(), 2);
  EXPECT_EQ(fits[1].start().polynomials.a.size(), 1);
}

TEST_F(StructureChoice, LeavesOrdersThatSuffice) {
  const Problem problem = problemOf(simulatedPlants(vectorOf({0.2}), vectorOf({-0.8})), 1, 1);
  const StructureFit small = plainFit(problem);
  const StructureFit same = withBetterOrders(problem, small, true, &journal_);
  EXPECT_EQ(same.structure.configuration.nominal_model.na, 1);
  EXPECT_EQ(same.log_likelihood, small.log_likelihood);
}

// Of two models the wrong one has the lower density on experiments that it was not fitted to; the
// densities of 200 samples of variance sigma^2 are about -100 (1 + log(2 pi sigma^2)).
TEST_F(StructureChoice, TheHeldOutDensityIsThatOfNewExperiments) {
  const auto experiments = simulatedPlants(vectorOf({0.2, 0.1}), vectorOf({-1.3, 0.4}));
  const Problem problem = problemOf(experiments, 1, 1);
  const StructureFit small = plainFit(problem);
  const StructureFit large = withBetterOrders(problem, small, true, &journal_);
  const double expected = -100 * (1 + std::log(2 * 3.14159265358979 * 1e-3));
  EXPECT_NEAR(heldOutDensity(problem, large, &journal_), expected, 20);
  EXPECT_LT(heldOutDensity(problem, small, &journal_), expected - 100);
}

// The variance is that of ten standard deviations of the outputs, and the noise, which an ARX model
// of each experiment shows, is 1e-3.
TEST_F(StructureChoice, ThePriorOfInitialValuesFollowsTheScaleOfTheData) {
  const auto experiments = simulatedPlants(vectorOf({0.2}), vectorOf({-0.8}));
  const EstimationOptions of_data = problemOf(experiments, 1, 1).configuration.estimation;
  double squares = 0, sum = 0;
  for (const Experiment& experiment : experiments) {
    squares += experiment.y.squaredNorm();
    sum += experiment.y.sum();
  }
  const double variance = squares / 2000 - std::pow(sum / 2000, 2);
  EXPECT_NEAR(of_data.initial_variance, 100 * variance, 1e-9 * variance);
  EXPECT_NEAR(of_data.initial_precision, 1e-3 / variance / 1000, 0.3e-6 / variance);
  std::vector<Experiment> scaled = experiments;
  for (Experiment& experiment : scaled) experiment.y *= 1e3;
  const EstimationOptions of_scaled = problemOf(scaled, 1, 1).configuration.estimation;
  EXPECT_NEAR(of_scaled.initial_variance / of_data.initial_variance, 1e6, 1);
  EXPECT_NEAR(of_scaled.initial_precision / of_data.initial_precision, 1, 1e-6);
  Configuration stated;
  stated.estimation.initial_precision = 0.5;
  stated.estimation.initial_variance = 2;
  const EstimationOptions kept = chooseInitialState(stated, data_, &journal_).estimation;
  EXPECT_EQ(kept.initial_precision, 0.5);
  EXPECT_EQ(kept.initial_variance, 2);
}

// A plant without dead time, whose estimate of one can only lie at its lower limit; and one that is
// late by about half a sample.
TEST_F(StructureChoice, TakesAWholeDelayForADeadTimeOfWholeSamples) {
  const auto withDeadTime = [&](const std::vector<Experiment>& experiments) {
    Problem problem = problemOf(experiments, 1, 1);
    NominalModelOptions& nominal = problem.configuration.nominal_model;
    nominal.structure = Structure::continuous;
    nominal.time_constants = 1;
    nominal.dead_time = true;
    nominal.max_delay = 3;
    return problem;
  };
  const Problem prompt = withDeadTime(simulatedPlants(vectorOf({0.2}), vectorOf({-0.8})));
  const StructureFit dead = plainFit(prompt);
  const StructureFit whole = withWholeDelay(prompt, dead, &journal_);
  EXPECT_FALSE(whole.structure.configuration.nominal_model.dead_time);
  EXPECT_EQ(whole.structure.configuration.nominal_model.delay, 1);
  EXPECT_EQ(whole.parameters, dead.parameters - 1);
  const Problem late = withDeadTime(simulatedPlants(vectorOf({0.1, 0.1}), vectorOf({-0.8})));
  const StructureFit half = withWholeDelay(late, plainFit(late), &journal_);
  EXPECT_TRUE(half.structure.configuration.nominal_model.dead_time);
}

}  // namespace
}  // namespace uncertainty_identification
