#include "curves/explain_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace uncertainty_identification {
namespace {

constexpr int kRuns = 12, kHeld = 6, kSamples = 200;

std::vector<Experiment> emptyRuns(int count, double sample_time) {
  std::vector<Experiment> all(static_cast<std::size_t>(count));
  for (Experiment& run : all) {
    run.id = "run " + std::to_string(&run - all.data());
    run.sample_time = sample_time;
    run.u.resize(kSamples);
    run.y.resize(kSamples);
  }
  return all;
}

/// Runs of y' = 0.9 y + 0.2 through(u) - force(y), with inputs held for some samples.
std::vector<Experiment> runs(int count, unsigned seed, const std::function<double(double)>& through,
                             const std::function<double(double)>& force,
                             double gain_spread = 0.02) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&] { return static_cast<double>(engine() >> 11) / 9007199254740992.0; };
  const auto normal = [&] {
    double sum = -6;
    for (int k = 0; k < 12; ++k) sum += uniform();
    return sum;
  };
  std::vector<Experiment> all = emptyRuns(count, 0.1);
  for (Experiment& run : all) {
    const double gain = 1 + gain_spread * normal();
    double x = 0, level = 0;
    int left = 0;
    for (int k = 0; k < kSamples; ++k) {
      if (left-- == 0) {
        left = 5 + static_cast<int>(15 * uniform());
        level = 4 * uniform() - 2;
      }
      run.u[k] = level;
      run.y[k] = x + 0.02 * normal();
      x = 0.9 * x + 0.2 * gain * through(level) - force(x);
    }
  }
  return all;
}

double same(double u) { return u; }
double none(double) { return 0; }
double deadZone(double u) { return std::abs(u) < 0.5 ? 0 : u > 0 ? u - 0.5 : u + 0.5; }

SimulationCauses explained(const std::vector<Experiment>& all, int threads = 1,
                           SimulationSearchOptions options = {}) {
  WorkerPool pool(threads);
  const std::vector<Experiment> fitted(all.begin(), all.end() - kHeld),
      held(all.end() - kHeld, all.end());
  return explainSimulation(fitted, held, options, &pool);
}

/// Records of one step each, of another size, to a plant whose force grows with the cube.
std::vector<Experiment> stepsOfSizes(const std::vector<double>& sizes) {
  std::vector<Experiment> all = emptyRuns(static_cast<int>(sizes.size()), 0.1);
  for (std::size_t r = 0; r < sizes.size(); ++r) {
    std::mt19937_64 engine(r + 1);
    std::normal_distribution<double> normal;
    double x = 0;
    for (int k = 0; k < kSamples; ++k) {
      all[r].u[k] = k < 20 ? 0 : sizes[r];
      all[r].y[k] = x + 0.01 * normal(engine);
      x = 0.9 * x + 0.2 * all[r].u[k] - 0.02 * x * x * x;
    }
  }
  return all;
}

TEST(ExplainSimulation, NamesNoCurveByFiveSteps) {
  WorkerPool pool(1);
  const auto by = [&](const std::vector<double>& sizes) {
    return explainSimulation(stepsOfSizes(sizes), {}, {}, &pool);
  };
  EXPECT_EQ(by({0.5, 1, 1.25, 1.5, 2}).skipped, "the input makes fewer than six steps");
  EXPECT_TRUE(by({0.5, 1, 1.25, 1.5, 2}).causes.empty());
  EXPECT_TRUE(by({0.5, 1, 1.25, 1.5, 1.75, 2}).skipped.empty());
}

/// Runs of a damper after Bouc and Wen: the force of a spring that yields, driven by the velocity.
std::vector<Experiment> ofADamper(int exponent) {
  std::vector<Experiment> all = emptyRuns(kRuns + kHeld, 0.01);
  for (std::size_t r = 0; r < all.size(); ++r) {
    std::mt19937_64 engine(r + 41);
    std::normal_distribution<double> normal;
    const double fast = 0.05 + 0.01 * static_cast<double>(r % 5),
                 size = 1 + 0.1 * static_cast<double>(r % 7);
    double z = 0;
    for (int k = 0; k < kSamples; ++k) {
      const double v = size * (std::sin(fast * k) + 0.6 * std::sin(0.37 * fast * k + 1));
      all[r].u[k] = v;
      all[r].y[k] = z + 0.01 * normal(engine);
      z += 0.2 * (v - std::abs(v) * z * std::pow(std::abs(z), exponent - 1));
    }
  }
  return all;
}

TEST(ExplainSimulation, NamesHysteresis) {
  for (const int exponent : {1, 2}) {
    const SimulationCauses found = explained(ofADamper(exponent));
    ASSERT_FALSE(found.causes.empty()) << exponent;
    EXPECT_EQ(found.causes.front().what.name, "plant_hysteresis") << exponent;
    EXPECT_GT(found.fit_after, 95);
  }
}

/// Runs whose output a second heater warms through a lag of 30 samples.
std::vector<Experiment> besideAHeater() {
  std::vector<Experiment> all = runs(kRuns + kHeld, 31, same, none);
  for (std::size_t r = 0; r < all.size(); ++r) {
    std::mt19937_64 engine(r + 77);
    Eigen::VectorXd heater(kSamples);
    double level = 0, wall = 0, own = 0;
    for (int k = 0; k < kSamples; ++k) {
      if (k % 40 == 5) level = static_cast<double>(engine() % 100);
      heater[k] = level;
      all[r].y[k] += own;
      own = 0.9 * own + 0.01 * wall;
      wall += (level - wall) / 30;
    }
    all[r].signals["heater"] = heater;
  }
  return all;
}

TEST(ExplainSimulation, NamesASecondInputThatActsThroughALagOfItsOwn) {
  const SimulationCauses found = explained(besideAHeater());
  ASSERT_EQ(found.causes.size(), 1u);
  const SimulationCause& heater = found.causes.front();
  EXPECT_EQ(heater.what.name, "exp_input2");
  EXPECT_EQ(heater.what.shape, "linear");
  EXPECT_EQ(heater.what.covariate, "heater behind a lag of 3.2 s");
  EXPECT_TRUE(heater.ties.empty()) << "an absolute value of what is never negative";
  EXPECT_GT(found.fit_after, 90);
}

TEST(ExplainSimulation, FindsNothingInALinearPlant) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const SimulationCauses found = explained(runs(kRuns + kHeld, seed, same, none));
    EXPECT_TRUE(found.causes.empty()) << found.causes.front().description;
    EXPECT_EQ(found.fit_before, found.fit_after);
    EXPECT_EQ(found.pictures.size(), 2u);
  }
}

TEST(ExplainSimulation, TellsHumThatThePlantHolds) {
  std::vector<Experiment> all = runs(kRuns + kHeld, 4, same, none);
  for (int k = 0; k < kSamples; ++k)
    for (Experiment& run : all) run.y[k] += 0.5 * std::sin(1.3 * k + run.u[0]);
  const SimulationCauses found = explained(all);
  EXPECT_NEAR(found.lasting_oscillation, 2.07, 0.01);
  EXPECT_EQ(found.order, 1);
}

/// A curve that takes little of the error away is no cause, however significant it is.
TEST(ExplainSimulation, NamesNoCurveThatHardlyMatters) {
  const auto with = [](double bend) {
    const auto bent = [bend](double u) { return u + bend * u * u; };
    return explained(runs(24 + kHeld, 5, bent, none, 0));
  };
  EXPECT_TRUE(with(0.005).causes.empty());
  EXPECT_EQ(with(0.01).causes.size(), 1u);
}

/// Runs of a servo motor, 8/(s (0.12 s + 1)) rad/V, that a PI controller holds at a setpoint of
/// steps against a load that comes and goes; the plant gets the voltage through(u).
std::vector<Experiment> servoRuns(unsigned seed, const std::function<double(double)>& through,
                                  double load) {
  constexpr double kStep = 0.05, kDecay = 0.659;  // [s]; exp(-kStep/0.12)
  constexpr int kServoSamples = 400;
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all(kRuns + kHeld);
  for (Experiment& run : all) {
    run.id = "run " + std::to_string(&run - all.data());
    run.sample_time = kStep;
    run.u.resize(kServoSamples);
    run.y.resize(kServoSamples);
    double angle = 3 + 0.5 * normal(engine), speed = 0, sum = 0, push = 0, setpoint = 3;
    for (int k = 0; k < kServoSamples; ++k) {
      if (k % 30 == 0) setpoint = 3 + normal(engine);
      run.y[k] = angle + 0.003 * normal(engine);
      const double error = setpoint - run.y[k];
      sum += 0.4 * kStep * error;
      run.u[k] = 1.1 * error + sum;
      push = 0.9 * push + load * std::sqrt(1 - 0.9 * 0.9) * normal(engine);
      const double next = kDecay * speed + (1 - kDecay) * 8 * (through(run.u[k]) + push);
      angle += kStep * (speed + next) / 2;
      speed = next;
    }
  }
  return all;
}

/// The free simulation of an integrating plant from an input that holds a controller's answers to
/// the load drifts away, and less with a dead zone, or a friction, that the plant does not have.
TEST(ExplainSimulation, NamesNothingInALinearServoThatAControllerHoldsAgainstALoad) {
  int refused = 0;
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const SimulationCauses found = explained(servoRuns(seed, same, 0.3));
    EXPECT_TRUE(found.causes.empty()) << "seed " << seed << ": " << found.causes.front().description
                                      << ", fit " << found.fit_before << " to " << found.fit_after;
    refused += found.refused.empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 0) << "where nothing simulates better, these data show nothing";
}

TEST(ExplainSimulation, NamesADeadZoneOfAServoInAClosedLoop) {
  for (const double load : {0.02, 0.1, 0.2}) {
    const SimulationCauses found = explained(servoRuns(1, deadZone, load));
    ASSERT_FALSE(found.causes.empty()) << "load " << load << ": " << found.refused;
    EXPECT_EQ(found.causes[0].what.name, "act_deadzone") << "load " << load;
    EXPECT_LT(found.fit_after, 75) << "above it, predictions would not be asked for";
  }
}

TEST(ExplainSimulation, NamesADeadZoneWithItsWidthAndCurve) {
  const SimulationCauses found = explained(runs(kRuns + kHeld, 4, deadZone, none));
  ASSERT_EQ(found.causes.size(), 1u);
  const SimulationCause& cause = found.causes.front();
  EXPECT_EQ(cause.what.name, "act_deadzone");
  EXPECT_EQ(cause.what.place, "input");
  EXPECT_EQ(cause.what.shape, "dead_zone");
  ASSERT_EQ(cause.values.size(), 1u);
  EXPECT_EQ(cause.values[0].name, "half_width");
  EXPECT_GT(cause.values[0].standard_error, 0);
  // Four standard errors: one in 16,000 by chance, but that they are estimated.
  EXPECT_NEAR(cause.values[0].value, 0.5, 4 * cause.values[0].standard_error);
  EXPECT_LT(cause.values[0].standard_error, 0.02);
  EXPECT_GT(found.fit_after, 90);
  EXPECT_LT(found.fit_before, found.fit_after);
  // The curve is flat within the zone and has one slope outside.
  ASSERT_EQ(cause.curve.signal.size(), 41u);
  EXPECT_EQ(cause.curve.unit, "input");
  for (std::size_t k = 0; k < cause.curve.signal.size(); ++k) {
    EXPECT_LE(cause.curve.lower_90[k], cause.curve.value[k]);
    EXPECT_GE(cause.curve.upper_90[k], cause.curve.value[k]);
  }
  const double middle = cause.curve.value[20], beside = cause.curve.value[22],
               end = cause.curve.value[40];
  EXPECT_NEAR(middle, beside, 0.02);
  EXPECT_GT(end - middle, 1);
}

TEST(ExplainSimulation, NamesAForceInThePlant) {
  const SimulationCauses found =
      explained(runs(kRuns + kHeld, 5, same, [](double x) { return 0.05 * x * std::abs(x); }));
  ASSERT_FALSE(found.causes.empty());
  EXPECT_EQ(found.causes.front().what.name, "plant_drag");
  EXPECT_EQ(found.causes.front().what.place, "position");
  EXPECT_GT(found.fit_after, found.fit_before + 2);
}

/// Runs of a flow that a PI controller holds at a setpoint of steps. The valve moves by `limit` per
/// sample at most; the input is what the controller asks for.
std::vector<Experiment> valveRuns(unsigned seed, double limit) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(2, 8);
  std::vector<Experiment> all = emptyRuns(kRuns + kHeld, 0.2);
  for (Experiment& run : all) {
    double flow = 4, valve = 33, sum = 33, setpoint = 4;
    for (int k = 0; k < kSamples; ++k) {
      if (k % 40 == 10) setpoint = uniform(engine);
      run.y[k] = flow + 0.02 * normal(engine);
      sum += 0.4 * (setpoint - run.y[k]);
      run.u[k] = 6 * (setpoint - run.y[k]) + sum;
      valve += std::min(std::max(run.u[k] - valve, -limit), limit);
      flow = 0.9 * flow + 0.1 * 0.12 * valve;
    }
  }
  return all;
}

/// Most changes of the input are noise, far below the limit of the rate.
TEST(ExplainSimulation, NamesALimitedRateInAClosedLoop) {
  for (const unsigned seed : {11u, 12u, 13u, 14u, 15u, 16u}) {
    const SimulationCauses found = explained(valveRuns(seed, 2));
    ASSERT_FALSE(found.causes.empty()) << "seed " << seed;
    EXPECT_EQ(found.causes.front().what.name, "act_ratelimit") << "seed " << seed;
    EXPECT_EQ(found.causes.size(), 1u) << "seed " << seed << ": what stood for it is dropped";
  }
}

/// Short records of a servo's answer to single steps. From free initial states, or with three
/// poles, a linear plant follows each of them.
TEST(ExplainSimulation, NamesALimitedRateInRecordsOfSingleSteps) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(0, 120);
    std::vector<Experiment> all = emptyRuns(kRuns + kHeld, 0.015);
    for (Experiment& run : all) {
      run.u.resize(70);
      run.y.resize(70);
      const double from = uniform(engine), to = uniform(engine);
      double asked = from, shown = from;
      for (int k = 0; k < 70; ++k) {
        run.u[k] = k < 4 ? from : to;
        run.y[k] = std::round(shown + 0.3 * normal(engine));
        asked += std::min(std::max(run.u[k] - asked, -2.7), 2.7);
        shown += 0.25 * (asked - shown);
      }
    }
    const SimulationCauses found = explained(all);
    ASSERT_FALSE(found.causes.empty()) << "seed " << seed;
    EXPECT_EQ(found.causes.front().what.name, "act_ratelimit") << "seed " << seed;
  }
}

/// A stirred heat exchanger whose thermometer lags: the flow multiplies the temperature, and the
/// lag is no dead time.
TEST(ExplainSimulation, CallsNoLagADeadTime) {
  std::mt19937_64 engine(12);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.1, 2);
  std::vector<Experiment> all = emptyRuns(kRuns + kHeld, 1);
  for (Experiment& run : all) {
    double inside = 40, middle = 40, shown = 40;
    for (int k = 0; k < kSamples; ++k) {
      run.u[k] = k % 25 == 0 ? uniform(engine) : run.u[k - 1];
      run.y[k] = shown + 0.1 * normal(engine);
      shown += (middle - shown) / 2;
      middle += (inside - middle) / 4;
      inside += 0.045 * run.u[k] * (15 - inside) + 0.02 * (80 - inside);
    }
  }
  const SimulationCauses found = explained(all);
  ASSERT_FALSE(found.causes.empty());
  for (const SimulationCause& cause : found.causes) EXPECT_EQ(cause.what.name, "plant_product");
}

/// Gains that differ by a tenth are no curve, though a memory of the first samples would help.
TEST(ExplainSimulation, DoesNotTakeDifferencesBetweenRunsForACurve) {
  for (const unsigned seed : {6u, 7u, 8u})
    EXPECT_TRUE(explained(runs(kRuns + kHeld, seed, same, none, 0.1)).causes.empty());
}

TEST(ExplainSimulation, DoesNotDependOnThreads) {
  const std::vector<Experiment> all = runs(kRuns + kHeld, 9, deadZone, none);
  const SimulationCauses one = explained(all, 1), two = explained(all, 2);
  ASSERT_EQ(one.causes.size(), two.causes.size());
  EXPECT_EQ(one.fit_after, two.fit_after);
  EXPECT_EQ(one.causes.front().values[0].value, two.causes.front().values[0].value);
}

TEST(ExplainSimulation, HoldsOutWindowsOfTooFewRuns) {
  const std::vector<Experiment> all = runs(8, 10, deadZone, none);
  WorkerPool pool(1);
  const SimulationCauses found = explainSimulation(all, {}, {}, &pool);
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes.front().what.name, "act_deadzone");
}

TEST(ExplainSimulation, LeavesOutPlacesWhoseNamesAreAllExcluded) {
  SimulationSearchOptions options;
  options.excluded = {"act_deadzone", "act_saturation", "act_asymmetry", "act_hammerstein"};
  const SimulationCauses found = explained(runs(kRuns + kHeld, 4, deadZone, none), 1, options);
  for (const SimulationCause& cause : found.causes) EXPECT_NE(cause.what.place, "input");
}

TEST(ExplainSimulation, DoesNotNameAShapeThatIsExcluded) {
  SimulationSearchOptions options;
  options.excluded = {"act_deadzone"};
  const SimulationCauses found = explained(runs(kRuns + kHeld, 4, deadZone, none), 1, options);
  for (const SimulationCause& cause : found.causes) EXPECT_NE(cause.what.name, "act_deadzone");
}

TEST(ExplainSimulation, SaysWhyItDidNotSearch) {
  WorkerPool pool(1);
  EXPECT_EQ(explainSimulation(runs(1, 1, same, none), {}, {}, &pool).skipped,
            "fewer than 200 samples");  // three windows of 66
  std::vector<Experiment> constant = runs(8, 1, same, none);
  for (Experiment& run : constant) run.u.setConstant(3);
  EXPECT_EQ(explainSimulation(constant, {}, {}, &pool).skipped, "the input is constant");
}

TEST(ExplainSimulation, CanBeCancelled) {
  SimulationSearchOptions options;
  int asked = 0;
  options.progress = [&asked](const std::string&) { return ++asked < 3; };
  const SimulationCauses found = explained(runs(kRuns + kHeld, 4, deadZone, none), 1, options);
  EXPECT_TRUE(found.ended_early && found.causes.empty());
}

}  // namespace
}  // namespace uncertainty_identification
