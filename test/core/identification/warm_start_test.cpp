// Experiments that do not start at rest, or have operating points of their own: first-order plants,
// simulated here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "estimation/first_samples.h"
#include "estimation/least_squares_start.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

/// Runs of an oven that was warm before, at any temperature: gain 2, time constant 40 samples, two
/// samples of dead time.
struct Ovens {
  int count = 12, samples = 400;
  double gain_spread = 0.06, tau_spread = 0.08;
  double offset_spread = 0;  ///< [unit of y]
  double noise_pole = 0.8;
  double noise = 0.1;  ///< standard deviation of what drives it [unit of y]
};

std::vector<Experiment> simulatedOvens(const Ovens& ovens, unsigned seed = 3) {
  constexpr int kHold = 25;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> power(0, 10), warm(5, 25);
  std::vector<Experiment> all;
  for (int r = 0; r < ovens.count; ++r) {
    Experiment one;
    one.id = "run " + std::to_string(r);
    one.sample_time = 1;
    one.u = one.y = Eigen::VectorXd::Zero(ovens.samples);
    const double gain = 2 * (1 + ovens.gain_spread * normal(random));
    const double pole = std::exp(-1 / (40 * (1 + ovens.tau_spread * normal(random))));
    const double offset = ovens.offset_spread * normal(random);
    double x = warm(random), disturbance = 0;
    for (int k = 0; k < ovens.samples; ++k) {
      one.u[k] = k % kHold == 0 ? power(random) : one.u[k - 1];
      disturbance = ovens.noise_pole * disturbance + ovens.noise * normal(random);
      one.y[k] = x + offset + disturbance;
      x = pole * x + gain * (1 - pole) * (k < 2 ? 5 : one.u[k - 2]);
    }
    all.push_back(std::move(one));
  }
  return all;
}

/// A first-order model of them whose gain, or gain and time constant, vary.
Configuration firstOrder(std::vector<std::string> varied) {
  Configuration configuration;
  NominalModelOptions& nominal = configuration.nominal_model;
  nominal.orders_auto = false;
  nominal.structure = Structure::continuous;
  nominal.time_constants = 1;
  nominal.delay = 3;
  nominal.nc = nominal.nd = 0;
  ErrorModelOptions& errors = configuration.error_model;
  errors.basis = BasisKind::parameter_spread;
  errors.constraint = Constraint::zero_mean;
  errors.parameters = std::move(varied);
  errors.components = 1;
  configuration.bounds.frequencies = 0;
  return configuration;
}

double deviation(const Estimate& estimate, Eigen::Index k) {
  return std::sqrt(estimate.error_model.mixture.covariance()(k, k));
}

// Standard deviations from 12 and 16 runs have relative standard errors of 20 %; the limits are
// three of them.
TEST(WarmStarts, OrderDelayAndWhatVariesAreFoundByDefault) {
  Configuration configuration;
  configuration.bounds.frequencies = 0;
  const Estimate found = Identifier(configuration).identify(simulatedOvens({}));
  EXPECT_EQ(found.nominal_model.a.size(), 1) << "a slow pole more follows what another gain leaves";
  EXPECT_EQ(found.nominal_model.delay, 3);
  EXPECT_EQ(found.error_model.options.parameters, (std::vector<std::string>{"gain", "tau1"}));
  EXPECT_TRUE(found.trust.trusted) << found.trust.reasons.front();
  EXPECT_NEAR(deviation(found, 0), 0.06, 0.036);
  EXPECT_NEAR(deviation(found, 1), 0.08, 0.048);
}

// The temperatures at the start are ten times what the input changes within a time constant: with
// another time constant they decay otherwise.
TEST(WarmStarts, TheFreeResponseTakesPartInTheLinearisation) {
  Ovens ovens;
  ovens.count = 16;
  ovens.samples = 120;
  ovens.noise_pole = 0;
  ovens.offset_spread = 1;
  const std::vector<Experiment> data = simulatedOvens(ovens);
  const auto fitted = [&](std::vector<std::string> varied) {
    Configuration configuration = firstOrder(std::move(varied));
    configuration.estimation.offsets = Offsets::per_experiment;
    configuration.estimation.initial_state = InitialState::estimate;
    return Identifier(configuration).identify(data);
  };
  const Estimate both = fitted({"gain", "tau1"});
  EXPECT_EQ(both.termination, Termination::converged) << both.message;
  EXPECT_GT(both.log_likelihood, fitted({"gain"}).log_likelihood + 50);
  EXPECT_NEAR(deviation(both, 1), 0.08, 0.045);
  EXPECT_NEAR(both.noise_variance.value, 0.01, 0.001);
}

class Offset : public testing::Test {
 protected:
  Offsets chosen(double spread) {
    Ovens ovens;
    ovens.offset_spread = spread;
    ovens.samples = 200;
    journal_.candidates.clear();
    data_ = checkData({}, simulatedOvens(ovens), &journal_);
    Problem problem{data_, {}, nullptr, {}, {}, {}};
    problem.configuration = chooseInitialState({}, data_, &journal_);
    return chooseOffsets(problem, &journal_).estimation.offsets;
  }

  Journal journal_{ProgressPhases({})};
  CheckedData data_;
};

TEST_F(Offset, IsOfEachExperimentOnlyWhereTheDataSpeakForIt) {
  EXPECT_EQ(chosen(5), Offsets::per_experiment);
  EXPECT_EQ(chosen(0), Offsets::estimate);
  ASSERT_GE(journal_.candidates.size(), 2u);
  const Candidate& common = journal_.candidates[journal_.candidates.size() - 2];
  EXPECT_EQ(common.choice, "offsets");
  EXPECT_TRUE(common.chosen);
}

TEST_F(Offset, IsCommonWhereExperimentsStartAtRest) {
  Ovens ovens;
  ovens.offset_spread = 5;
  ovens.samples = 200;
  data_ = checkData({}, simulatedOvens(ovens), &journal_);
  Problem problem{data_, {}, nullptr, {}, {}, {}};
  problem.configuration.estimation.initial_state = InitialState::zero;
  EXPECT_EQ(chooseOffsets(problem, &journal_).estimation.offsets, Offsets::estimate);
}

TEST_F(Offset, ThatIsGivenStays) {
  const std::vector<Experiment> data = simulatedOvens({});
  data_ = checkData({}, data, &journal_);
  Problem problem{data_, {}, nullptr, {}, {}, {}};
  problem.configuration.estimation.offsets = Offsets::none;
  EXPECT_EQ(chooseOffsets(problem, &journal_).estimation.offsets, Offsets::none);
}

// Each coefficient of B that is not needed adds an unknown initial value to each experiment, which
// costs several nats; after the first samples it costs what two more parameters gain.
TEST(FirstSamples, TakeUpWhatUnknownInitialValuesCost) {
  Ovens ovens;
  ovens.noise_pole = ovens.gain_spread = ovens.tau_spread = 0;
  const std::vector<Experiment> data = simulatedOvens(ovens);
  const auto fitted = [&](int nb) {
    Configuration configuration;
    NominalModelOptions& nominal = configuration.nominal_model;
    nominal.orders_auto = false;
    nominal.structure = Structure::output_error;
    nominal.na = 1;
    nominal.nb = nb;
    nominal.delay = 3;
    configuration.error_model.basis = BasisKind::fir;
    configuration.error_model.taps = 0;
    configuration.estimation.offsets = Offsets::estimate;
    configuration.bounds.frequencies = 0;
    return configuration;
  };
  Journal journal{ProgressPhases({})};
  const CheckedData checked = checkData({}, data, &journal);
  const auto densities = [&](int nb) {
    Problem problem{checked, {}, nullptr, fitted(nb), {}, {}};
    problem.configuration = chooseInitialState(problem.configuration, checked, &journal);
    const auto fit = fitStructure(problem, {"none", problem.configuration}, {}, true, &journal);
    const double of_first = firstSamplesDensity(*fit->model, fit->point, data, 1, &journal.passes);
    return std::make_pair(fit->log_likelihood, fit->log_likelihood + of_first);
  };
  const auto smaller = densities(1), larger = densities(3);
  EXPECT_GT(smaller.second - larger.second, 2 * ovens.count);
  EXPECT_NEAR(smaller.first, larger.first, 0.25 * ovens.count);
}

TEST(WarmStarts, DoNotMisleadLeastSquaresThatAllowForThem) {
  Ovens ovens;
  ovens.noise_pole = ovens.gain_spread = ovens.tau_spread = 0;
  const std::vector<Experiment> data = simulatedOvens(ovens);
  std::vector<const Experiment*> all;
  for (const Experiment& one : data) all.push_back(&one);
  const LeastSquaresStart start(all, Constant::common);
  const Polynomials found =
      start.steiglitzMcBride(1, 1, 0, 10, LeastSquaresStart::Start::unknown).polynomials;
  EXPECT_EQ(found.delay, 3);
  EXPECT_NEAR(-1 / std::log(-found.a[0]), 40, 0.5) << "[samples]";
  const std::vector<int> delays = start.likelyDelays(1, 1, 10);
  EXPECT_EQ(std::count(delays.begin(), delays.end(), 3), 1);
}

}  // namespace
}  // namespace uncertainty_identification
