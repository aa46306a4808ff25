// Compares the likelihood from sufficient statistics with the N x N reference, for everything that
// a record can contain: noise before the first sample, unknown initial states, offsets, gaps,
// different lengths.
#include "estimation/likelihood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// One system with the configuration it is evaluated under, and the same for the reference.
struct Case {
  std::string name;
  test::RandomSystemOptions system;
  std::function<void(Configuration&, dense::Model&, dense::Options&)> change;
  std::function<void(std::vector<Experiment>&)> spoil;
};

Case caseOf(const std::string& name) {
  Case made;
  made.name = name;
  made.system.experiments = 5;
  made.system.min_samples = made.system.max_samples = 60;
  made.system.noise_run_up = 300;
  made.change = [](Configuration& c, dense::Model&, dense::Options& o) {
    c.estimation.noise_start = o.noise_start = NoiseStart::stationary;
  };
  return made;
}

void markMissing(std::vector<Experiment>& experiments, std::initializer_list<int> samples) {
  for (Experiment& experiment : experiments) {
    if (experiment.valid.empty()) {
      experiment.valid.assign(static_cast<std::size_t>(experiment.samples()), 1);
    }
    for (int k : samples) {
      experiment.valid[static_cast<std::size_t>(k)] = 0;
      experiment.y[k] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

std::vector<Case> noiseCases() {
  std::vector<Case> cases;
  cases.push_back(caseOf("arma11"));
  cases.push_back(caseOf("arma32"));
  cases.back().system.nd = 3;
  cases.back().system.nc = 2;
  cases.push_back(caseOf("arma23"));
  cases.back().system.nd = 2;
  cases.back().system.nc = 3;
  cases.push_back(caseOf("movingAverage"));
  cases.back().system.nd = 0;
  cases.back().system.nc = 2;
  cases.push_back(caseOf("white"));
  cases.back().system.nd = cases.back().system.nc = 0;
  cases.push_back(caseOf("slowNoise"));
  cases.back().change = [](Configuration& c, dense::Model& m, dense::Options& o) {
    c.estimation.noise_start = o.noise_start = NoiseStart::stationary;
    m.d[0] = -0.999;
  };
  return cases;
}

std::vector<Case> gapCases() {
  std::vector<Case> cases;
  const auto add = [&cases](const std::string& name, std::initializer_list<int> missing) {
    cases.push_back(caseOf(name));
    cases.back().system.nd = 2;
    cases.back().spoil = [list = std::vector<int>(missing)](std::vector<Experiment>& experiments) {
      for (int k : list) markMissing(experiments, {k});
    };
  };
  add("gapAtTheStart", {0, 1, 2});
  add("gapInTheMiddle", {20, 21, 22, 23, 40});
  add("gapAtTheEnd", {57, 58, 59});
  add("alternatingGaps", {10, 12, 14, 16, 17, 19, 20, 21, 23});
  add("allButFew", {1, 2, 3, 4, 6, 7, 8, 9, 10, 12, 13, 14, 16, 18, 19, 20, 22});
  cases.push_back(caseOf("randomGaps"));
  cases.back().system.missing = 0.3;
  cases.back().system.nd = 3;
  cases.back().system.nc = 2;
  cases.push_back(caseOf("gapsFromRest"));
  cases.back().system.missing = 0.3;
  cases.back().system.noise_run_up = 0;
  cases.back().change = {};
  cases.push_back(caseOf("gapsInWhiteNoise"));
  cases.back().system.missing = 0.3;
  cases.back().system.nc = cases.back().system.nd = 0;
  return cases;
}

std::vector<Case> stateCases() {
  std::vector<Case> cases;
  const auto estimate = [](Configuration& c, dense::Model&, dense::Options& o) {
    c.estimation.noise_start = o.noise_start = NoiseStart::stationary;
    c.estimation.initial_state = o.initial_state = InitialState::estimate;
  };
  const auto add = [&](const std::string& name) -> test::RandomSystemOptions& {
    cases.push_back(caseOf(name));
    cases.back().change = estimate;
    cases.back().system.input_run_up = 200;
    return cases.back().system;
  };
  add("diffuseFir").taps = 3;
  add("diffuseLaguerre").laguerre_pole = 0.4;
  add("diffuseNominalOnly").taps = 0;
  auto& high = add("diffuseHighOrder");
  high.nb = 2;
  high.na = 3;
  high.delay = 3;
  high.pole_radius = 0.8;
  add("diffuseWithGaps").missing = 0.2;
  add("diffuseKautz").taps = 4;
  cases.back().change = [estimate](Configuration& c, dense::Model& m, dense::Options& o) {
    estimate(c, m, o);
    c.error_model.basis = BasisKind::kautz;
    c.error_model.constraint = Constraint::free;
    c.error_model.pole_real = 0.4;
    c.error_model.pole_imag = 0.3;
    m.basis = dense::kautzBasis(0.4, 0.3, 4, 200);
    const VectorXd section = Eigen::Vector3d(1, -0.8, 0.25);
    m.basis_denominator = dense::product(section, section).tail(4);
    m.basis_order = 4;
    m.T = Eigen::MatrixXd::Identity(4, 4);
  };
  cases.back().system.zero_static_gain = false;
  return cases;
}

/// If samples are missing, the data do not depend on some directions of the initial state, and the
/// remaining columns are linearly dependent.
std::vector<Case> hiddenStateCases() {
  std::vector<Case> cases = {caseOf("hiddenFirstSamples"), caseOf("hiddenByLongGap")};
  for (Case& one : cases) {
    one.system.nc = one.system.nd = 0;
    one.system.delay = 3;
    one.system.taps = 2;
    one.change = [](Configuration& c, dense::Model&, dense::Options& o) {
      c.estimation.initial_state = o.initial_state = InitialState::estimate;
    };
  }
  cases[0].spoil = [](std::vector<Experiment>& all) { markMissing(all, {0, 1}); };
  cases[1].spoil = [](std::vector<Experiment>& all) {
    markMissing(all, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  };
  return cases;
}

std::vector<Case> nuisanceCases() {
  std::vector<Case> cases;
  cases.push_back(caseOf("ownOffsets"));
  cases.back().system.output_offset = 2;
  cases.back().change = [](Configuration& c, dense::Model&, dense::Options& o) {
    c.estimation.noise_start = o.noise_start = NoiseStart::stationary;
    c.estimation.offsets = Offsets::per_experiment;
    o.diffuse_offset = true;
  };
  cases.push_back(caseOf("ownOffsetsAndStates"));
  cases.back().system.missing = 0.2;
  cases.back().change = [](Configuration& c, dense::Model&, dense::Options& o) {
    c.estimation.noise_start = o.noise_start = NoiseStart::stationary;
    c.estimation.initial_state = o.initial_state = InitialState::estimate;
    c.estimation.offsets = Offsets::per_experiment;
    o.diffuse_offset = true;
  };
  cases.push_back(caseOf("commonOutputOffset"));
  cases.back().change = [](Configuration& c, dense::Model&, dense::Options& o) {
    c.estimation.noise_start = o.noise_start = NoiseStart::stationary;
    c.estimation.offsets = Offsets::estimate;
    o.output_offset = 1.3;
  };
  cases.push_back(caseOf("commonInputOffset"));
  cases.back().change = [](Configuration& c, dense::Model&, dense::Options& o) {
    c.estimation.noise_start = o.noise_start = NoiseStart::stationary;
    c.estimation.offsets = Offsets::estimate;
    c.estimation.offset_side = OffsetSide::input;
    o.input_offset = -1.3;
  };
  cases.push_back(caseOf("discard"));
  cases.back().system.input_run_up = 100;
  cases.back().system.missing = 0.2;
  cases.back().change = [](Configuration& c, dense::Model&, dense::Options& o) {
    c.estimation.noise_start = o.noise_start = NoiseStart::stationary;
    c.estimation.initial_state = o.initial_state = InitialState::discard;
    c.estimation.discard_samples = o.discard_samples = 13;
  };
  cases.push_back(caseOf("discardAllOfSome"));
  cases.back().change = [](Configuration& c, dense::Model&, dense::Options& o) {
    c.estimation.noise_start = o.noise_start = NoiseStart::stationary;
    c.estimation.initial_state = o.initial_state = InitialState::discard;
    c.estimation.discard_samples = o.discard_samples = 50;
  };
  cases.back().system.min_samples = 52;
  return cases;
}

std::vector<Case> shapeCases() {
  std::vector<Case> cases;
  const auto add = [&](const std::string& name, int delay, int nb, int na) {
    cases.push_back(caseOf(name));
    cases.back().system.components = 3;
    cases.back().system.taps = 3;
    cases.back().system.delay = delay;
    cases.back().system.nb = nb;
    cases.back().system.na = na;
    cases.back().system.min_samples = 9;
    cases.back().system.experiments = 11;
  };
  add("noDelay", 0, 2, 1);
  add("delay2", 2, 1, 3);
  add("staticPlant", 1, 3, 0);
  add("fiveTapsFromRest", 1, 5, 2);
  cases.back().system.taps = 5;
  cases.back().change = {};
  add("freeGain", 1, 1, 1);
  cases.back().system.zero_static_gain = false;
  cases.back().system.taps = 1;
  return cases;
}

class DenseReference : public testing::TestWithParam<Case> {};

TEST_P(DenseReference, SameLikelihood) {
  const Case& one = GetParam();
  for (std::uint64_t seed : {1u, 2u}) {
    test::RandomSystem system = test::randomSystem(one.system, seed);
    Configuration configuration = test::configurationOf(one.system);
    dense::Options options;
    if (one.change) one.change(configuration, system.truth, options);
    if (one.spoil) one.spoil(system.experiments);
    ModelParameters at = test::parametersOf(system.truth);
    at.parameters *= 1.02;  // beside the truth, where no derivative vanishes
    system.truth.b *= 1.02;
    system.truth.a *= 1.02;
    system.truth.c *= 1.02;
    system.truth.d *= 1.02;
    if (one.name == "slowNoise") {
      system.truth.d /= 1.02;
      at.parameters.tail(1) /= 1.02;
    }
    if (configuration.estimation.offsets == Offsets::estimate) {
      at.parameters = test::appended(at.parameters, 1.3);
    }
    const test::CoreSetup setup(configuration, system.experiments);
    ASSERT_TRUE(setup.model().admissible(at.parameters));
    const VectorXd found = setup.expect(at).log_likelihood;
    const Statistics statistics = setup.likelihood().statistics(at.parameters, false);
    for (std::size_t r = 0; r < system.experiments.size(); ++r) {
      const auto expected = dense::evaluate(system.experiments[r], system.truth, options);
      const auto at_r = static_cast<Eigen::Index>(r);
      EXPECT_NEAR(found[at_r], expected.log_likelihood,
                  1e-9 * std::max(1.0, std::abs(expected.log_likelihood)))
          << "experiment " << r << " of seed " << seed;
      EXPECT_EQ(statistics.samples()[at_r], expected.degrees_of_freedom) << "experiment " << r;
    }
  }
}

std::string nameOf(const testing::TestParamInfo<Case>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(Noise, DenseReference, testing::ValuesIn(noiseCases()), nameOf);
INSTANTIATE_TEST_SUITE_P(Gaps, DenseReference, testing::ValuesIn(gapCases()), nameOf);
INSTANTIATE_TEST_SUITE_P(InitialState, DenseReference, testing::ValuesIn(stateCases()), nameOf);
INSTANTIATE_TEST_SUITE_P(HiddenState, DenseReference, testing::ValuesIn(hiddenStateCases()),
                         nameOf);
INSTANTIATE_TEST_SUITE_P(Nuisances, DenseReference, testing::ValuesIn(nuisanceCases()), nameOf);
INSTANTIATE_TEST_SUITE_P(Shapes, DenseReference, testing::ValuesIn(shapeCases()), nameOf);

/// A constant added to the input changes the output by a constant response of Go, which an own
/// offset at the input of a model without relative error takes up whole.
TEST(OwnInputOffset, TakesUpAConstantInput) {
  test::RandomSystemOptions options;
  options.taps = 0;
  options.na = 2;
  auto system = test::randomSystem(options, 4);
  Configuration configuration = test::configurationOf(options);
  configuration.estimation.offsets = Offsets::per_experiment;
  configuration.estimation.offset_side = OffsetSide::input;
  const ModelParameters at = test::parametersOf(system.truth);
  const double before = test::CoreSetup(configuration, system.experiments).logLikelihood(at);
  for (Experiment& experiment : system.experiments) experiment.u.array() += 0.7;
  const double after = test::CoreSetup(configuration, system.experiments).logLikelihood(at);
  EXPECT_NEAR(after, before, 1e-9 * std::abs(before));
  configuration.estimation.offsets = Offsets::none;
  EXPECT_GT(before - test::CoreSetup(configuration, system.experiments).logLikelihood(at), 10);
}

/// Blocks are reduced in a fixed order, whichever thread computed them.
TEST(Threads, ChangeNoBit) {
  test::RandomSystemOptions options;
  options.experiments = 60;
  options.missing = 0.1;
  const auto system = test::randomSystem(options, 3);
  const ModelParameters at = test::parametersOf(system.truth);
  Configuration configuration = test::configurationOf(options);
  configuration.estimation.initial_state = InitialState::estimate;
  const test::CoreSetup one(configuration, system.experiments, 1);
  const Statistics statistics = one.likelihood().statistics(at.parameters, true);
  const Expectation e = one.likelihood().expect(statistics, at);
  const auto of_one = one.likelihood().information(at, latentMoments(e));
  for (int threads : {2, 3, 5}) {
    const test::CoreSetup several(configuration, system.experiments, threads);
    const Statistics again = several.likelihood().statistics(at.parameters, true);
    const Expectation expectation = several.likelihood().expect(again, at);
    EXPECT_EQ(expectation.log_likelihood, e.log_likelihood) << threads;
    EXPECT_EQ(scores(again, at, expectation), scores(statistics, at, e)) << threads;
    const auto information = several.likelihood().information(at, latentMoments(expectation));
    EXPECT_EQ(information.observed, of_one.observed) << threads;
  }
}

}  // namespace
}  // namespace uncertainty_identification
