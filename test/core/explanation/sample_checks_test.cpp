// Which defects of the sensor are found in samples that repeat each other exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "explanation/masked_samples.h"
#include "support/example1.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {
namespace {

bool names(const Explanation& explanation, const std::string& name) {
  return std::any_of(explanation.causes.begin(), explanation.causes.end(),
                     [&](const Cause& cause) { return cause.name == name; });
}

TEST(SampleChecks, ASystemAtRestBeforeTheTestIsNoFault) {
  constexpr int kRest = 20;
  std::vector<Experiment> all = example1Experiments(12);
  for (Experiment& experiment : all) {
    for (Eigen::VectorXd* signal : {&experiment.u, &experiment.y}) {
      const Eigen::VectorXd moving = *signal;
      signal->setZero(kRest + moving.size());
      signal->tail(moving.size()) = moving;
    }
  }
  const Explanation found = explain(example1Configuration(), all);
  EXPECT_FALSE(names(found, "sens_clip"));
  EXPECT_FALSE(names(found, "sens_dropout"));
}

TEST(SampleChecks, ACoarseSensorWithUnequalStepsDoesNotHang) {
  std::vector<Experiment> all = example1Experiments(12);
  for (Experiment& experiment : all)
    experiment.y = (experiment.y.array() / 5).sinh().unaryExpr([](double y) {
      return std::asinh(std::round(y * 20) / 20) * 5;
    });
  EXPECT_FALSE(names(explain(example1Configuration(), all), "sens_dropout"));
}

TEST(SampleChecks, ASensorThatHangsIsNamed) {
  std::vector<Experiment> all = example1Experiments(12);
  for (Experiment& experiment : all) {
    for (int t = 30; t < 34; ++t) experiment.y[t] = experiment.y[29];
  }
  EXPECT_TRUE(names(explain(example1Configuration(), all), "sens_dropout"));
}

/// White noise of variance 4, as two experiments.
std::vector<Experiment> noise() {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal(0, 2);
  std::vector<Experiment> all(2);
  for (Experiment& experiment : all) {
    experiment.u = experiment.y = Eigen::VectorXd::NullaryExpr(500, [&] { return normal(engine); });
  }
  return all;
}

TEST(SampleChecks, ContinuousNoiseHasNone) { EXPECT_TRUE(checkSamples(noise()).empty()); }

TEST(SampleChecks, ALatticeIsASensorThatReadsInSteps) {
  std::vector<Experiment> experiments = noise();
  for (Experiment& experiment : experiments)
    experiment.y = (0.3 * (experiment.y.array() / 0.3).round() + 0.07).matrix();
  const auto found = checkSamples(experiments);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trait, Trait::quantisation);
  EXPECT_NEAR(found[0].parameters.at(0).value, 0.3, 1e-9);
  const auto kept = withoutSpoiled(experiments, found[0]);
  EXPECT_EQ(kept[0].validSamples(), 500) << "steps spoil no sample";
}

/// A thermometer of 1/16 degree, printed with two decimals, of a body that warms up slowly: its
/// readings repeat, but it does not hang.
TEST(SampleChecks, StepsAreSeenThroughTheRoundingOfAFile) {
  std::vector<Experiment> experiments(1);
  experiments[0].u = Eigen::VectorXd::Ones(200);
  experiments[0].y.resize(200);
  for (int t = 0; t < 200; ++t) {
    const double degrees = 27.5 + 2.5 * (1 - std::exp(-t / 80.0));
    experiments[0].y[t] = std::floor(100 * (std::floor(16 * degrees) / 16)) / 100;
  }
  const auto found = checkSamples(experiments);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trait, Trait::quantisation);
  EXPECT_NEAR(found[0].parameters.at(0).value, 1.0 / 16, 1e-3);
}

TEST(SampleChecks, RepeatedExtremesAreALimit) {
  std::vector<Experiment> experiments = noise();
  int clipped = 0;
  for (Experiment& experiment : experiments) {
    clipped += static_cast<int>((experiment.y.array() > 3).count());
    experiment.y = experiment.y.cwiseMin(3);
  }
  const auto found = checkSamples(experiments);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trait, Trait::output_limit);
  EXPECT_EQ(found[0].parameters.at(0).value, -HUGE_VAL) << "nothing is clipped below";
  EXPECT_EQ(found[0].parameters.at(1).value, 3);
  int valid = 0;
  for (const Experiment& experiment : withoutSpoiled(experiments, found[0]))
    valid += experiment.validSamples();
  EXPECT_EQ(valid, 1000 - clipped);
}

TEST(SampleChecks, ALimitIsNoneWhereOtherExperimentsReadBeyondIt) {
  SpoiltSamples limit{Trait::output_limit, {}};
  limit.parameters.resize(2);
  limit.parameters[0].value = -HUGE_VAL;
  limit.parameters[1].value = 3;
  std::vector<Experiment> others = noise();
  EXPECT_TRUE(isExceeded(limit, others));
  for (Experiment& experiment : others) experiment.y = experiment.y.cwiseMin(3.0);
  EXPECT_FALSE(isExceeded(limit, others));
  EXPECT_FALSE(isExceeded({Trait::quantisation, {}}, others));
}

/// A robot's joint that waits at the end of its path, held by friction while the command creeps.
/// The command leaves three samples before it.
TEST(SampleChecks, AMachineThatRestsAtItsLargestOutputHasNoLimit) {
  std::vector<Experiment> all = noise();
  all[0].y.segment(100, 60).setConstant(20);
  all[0].u.segment(97, 60) = Eigen::VectorXd::LinSpaced(60, 15, 15.5);
  EXPECT_TRUE(checkSamples(all).empty());
  all[0].u.segment(97, 30).setConstant(12);
  EXPECT_EQ(checkSamples(all).size(), 1u) << "two commands, one value";
}

/// A sensor whose steps are uneven repeats all its values, its extremes no more than others.
TEST(SampleChecks, ARecordThatBeginsAndEndsAtRestHasNoLimit) {
  std::vector<Experiment> experiments = noise();
  for (Experiment& experiment : experiments) {
    experiment.y = experiment.y.array().abs() + 1;
    experiment.y.head(6).setZero();
  }
  EXPECT_TRUE(checkSamples(experiments).empty());
  experiments[1].y.tail(8).setZero();
  EXPECT_TRUE(checkSamples(experiments).empty());
  for (int t = 50; t < 500; t += 60) experiments[0].y[t] = 0;
  const auto found = checkSamples(experiments);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trait, Trait::output_limit);
}

TEST(SampleChecks, ExtremesOfACoarseSensorAreNoLimit) {
  std::vector<Experiment> coarse = noise();
  for (Experiment& experiment : coarse)
    for (int k = 0; k < experiment.samples(); ++k) {
      const double step = std::round(std::min(std::max(experiment.y[k] / 2, -2.0), 2.0));
      experiment.y[k] = step + 0.01 * step * step;  // five levels, the outer ones 70 times each
    }
  for (const SpoiltSamples& found : checkSamples(coarse))
    EXPECT_NE(found.trait, Trait::output_limit);
}

/// Readings of hundredths, which most samples read but once.
TEST(SampleChecks, AMachineThatTurnsRoundHasNoLimit) {
  constexpr int kSamples = 300;
  std::vector<Experiment> slow{noise().front()};
  slow[0].u.conservativeResize(kSamples);
  slow[0].y.resize(kSamples);
  for (int t = 0; t < kSamples; ++t)
    slow[0].y[t] = std::round(500 * std::sin(1.57 * std::sin(0.0317 * t))) / 100;
  EXPECT_TRUE(checkSamples(slow).empty());
  for (Experiment& experiment : slow) experiment.y = experiment.y.cwiseMin(4);
  const auto found = checkSamples(slow);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trait, Trait::output_limit);
  EXPECT_EQ(found[0].parameters.at(1).value, 4);
}

TEST(SampleChecks, RepeatedValuesAreASensorThatHolds) {
  std::vector<Experiment> experiments = noise();
  for (int t = 10; t < 500; t += 100) experiments[1].y[t] = experiments[1].y[t - 1];
  const auto found = checkSamples(experiments);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trait, Trait::held_samples);
  EXPECT_DOUBLE_EQ(found[0].parameters.at(0).value, 5.0 / 1000);
  const auto kept = withoutSpoiled(experiments, found[0]);
  EXPECT_EQ(kept[0].validSamples(), 500);
  EXPECT_EQ(kept[1].validSamples(), 495);
  EXPECT_FALSE(kept[1].isValid(110));
}

/// Where the stamps are irregular, one reading may be the newest at two points of the grid.
TEST(SampleChecks, AReadingThatIsTakenTwiceIsNoSensorThatHolds) {
  std::vector<Experiment> experiments = noise();
  experiments[1].sample_time = 0.1;
  experiments[1].stamp_offset = Eigen::VectorXd::Zero(500);
  for (int t = 10; t < 500; t += 100) {
    experiments[1].y[t] = experiments[1].y[t - 1];
    experiments[1].stamp_offset[t] = -0.06;
    experiments[1].stamp_offset[t - 1] = 0.04;
  }
  EXPECT_TRUE(checkSamples(experiments).empty());
  experiments[1].stamp_offset.setConstant(0.01);
  EXPECT_EQ(checkSamples(experiments).size(), 1u) << "readings of their own that repeat";
}

/// A motor whose friction lets it move only where the input exceeds it, read by an encoder of whole
/// steps; `loses`: instead, it always moves, and one reading in ten is the last one again.
std::vector<Experiment> encoder(bool loses) {
  std::mt19937_64 engine(7);
  std::vector<Experiment> all(2);
  for (Experiment& experiment : all) {
    experiment.u = experiment.y = Eigen::VectorXd::Zero(400);
    double speed = 0, angle = &experiment == &all.front() ? 0 : 1e6;
    for (int t = 0; t < 400; ++t) {
      const double input = 100 + (t / 40 % 3) * 30;
      experiment.u[t] = loses || t / 20 % 2 == 1 ? input : 0;
      speed += 0.4 * (experiment.u[t] - speed);
      if (!loses && speed < 20) speed = 0;
      angle += speed;
      const bool lost = loses && t > 0 && engine() % 10 == 0;
      experiment.y[t] = lost ? experiment.y[t - 1] : std::round(angle);
    }
  }
  return all;
}

TEST(SampleChecks, AMachineThatStandsStillIsNoSensorThatHolds) {
  EXPECT_TRUE(checkSamples(encoder(false)).empty());
  const auto found = checkSamples(encoder(true));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trait, Trait::held_samples);
}

// An oven that warms up, read in steps of 0.25 degrees; the logger averages eight readings, so that
// many of its values are no multiples of the steps.
/// A record that is filled up with its last value: nothing is read after it.
TEST(SampleChecks, ARecordThatEndsWithItsLastValueIsNoSensorThatHolds) {
  Experiment swings;
  swings.sample_time = 0.1;
  swings.u = Eigen::VectorXd::Ones(500);
  swings.y.resize(500);
  for (int t = 0; t < 500; ++t) swings.y[t] = std::sin(0.1 * std::min(t, 320));
  EXPECT_TRUE(checkSamples({swings}).empty());
}

TEST(SampleChecks, ASlowSignalInCoarseStepsIsNoSensorThatHolds) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> noise(0, 0.02);
  Experiment oven;
  oven.u = oven.y = Eigen::VectorXd::Ones(500);
  for (int t = 0; t < 500; ++t) {
    double sum = 0;
    for (int k = 0; k < 8; ++k)
      sum += 0.25 * std::floor((200 + 0.08 * (t + k / 8.0) + noise(engine)) / 0.25);
    oven.y[t] = sum / 8;
  }
  EXPECT_TRUE(checkSamples({oven}).empty());
  for (int t = 0; t < 500; ++t)
    oven.y[t] = 200 * (1 - std::exp(-(t % 10 == 9 ? t - 1 : t) / 250.0));
  EXPECT_EQ(checkSamples({oven}).size(), 1u) << "a fine sensor that holds one reading in ten";
  for (int t = 0; t < 500; ++t) oven.y[t] = 0.1234567 * (t % 10 == 9 ? t - 1 : t);
  EXPECT_EQ(checkSamples({oven}).size(), 1u) << "the same of a ramp, whose steps are all alike";
}

TEST(SampleChecks, OfARestBeforeTheTestThreeSamplesStay) {
  Experiment rested;
  rested.sample_time = 0.5;
  rested.u = Eigen::VectorXd::Zero(50);
  rested.y = Eigen::VectorXd::Constant(50, 2);
  rested.u.tail(30).setOnes();
  rested.y.tail(28).setLinSpaced(2.1, 5);
  rested.signals["load"] = Eigen::VectorXd::LinSpaced(50, 0, 49);
  const Experiment cut = withoutRest({rested}).front();
  ASSERT_EQ(cut.samples(), 33);
  EXPECT_EQ(cut.start_time, 8.5);
  EXPECT_EQ(cut.u[2], 0);
  EXPECT_EQ(cut.u[3], 1);
  EXPECT_EQ(cut.y[4], 2);
  EXPECT_EQ(cut.signals.at("load")[0], 17);
  EXPECT_EQ(cut.validSamples(), 33) << "the dead time of the output is left";
  rested.u[2] = 1;
  EXPECT_EQ(withoutRest({rested}).front().samples(), 50) << "the input moves, the output does not";
}

/// A heater that is read with noise, and whose highest input alone leads beyond the range; without
/// noise, it may rest there.
TEST(SampleChecks, ANoisyReadingThatStaysAtItsLargestIsALimit) {
  const auto heater = [](double size) {
    std::mt19937_64 engine(8);
    std::normal_distribution<double> normal;
    std::vector<Experiment> one{noise().front()};
    double x = 0;
    for (int t = 0; t < 500; ++t) {
      one[0].u[t] = t / 50 % 4;
      x += 0.2 * (one[0].u[t] - x);
      one[0].y[t] = std::min(x + size * normal(engine), 2.5);
    }
    return one;
  };
  const auto found = checkSamples(heater(0.02));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trait, Trait::output_limit);
  EXPECT_EQ(found[0].parameters.at(1).value, 2.5);
  EXPECT_TRUE(checkSamples(heater(0)).empty());
}

TEST(SampleChecks, ALargestValueThatIsHeldIsNoLimit) {
  std::vector<Experiment> experiments = noise();
  for (int t = 10; t < 500; t += 100) experiments[1].y[t] = experiments[1].y[t - 1];
  Eigen::Index largest = 0;
  experiments[0].y.head(490).maxCoeff(&largest);
  experiments[0].y[largest] += 10;
  for (int t = 1; t < 6; ++t) experiments[0].y[largest + t] = experiments[0].y[largest];
  const auto found = checkSamples(experiments);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].trait, Trait::held_samples);
}

/// A gauge whose readings stand still for days at several levels, in rain and without.
TEST(SampleChecks, AReadingThatStandsStillElsewhereTooIsNoLimit) {
  const auto hasLimit = [](const std::vector<Experiment>& experiments) {
    const auto found = checkSamples(experiments);
    return std::any_of(found.begin(), found.end(),
                       [](const SpoiltSamples& one) { return one.trait == Trait::output_limit; });
  };
  std::vector<Experiment> experiments = noise();
  Eigen::VectorXd& y = experiments[0].y;
  y.segment(100, 7).setConstant(-20);
  EXPECT_TRUE(hasLimit(experiments));
  y.segment(200, 6).setConstant(20);
  EXPECT_TRUE(hasLimit(experiments)) << "a limit on both sides";
  experiments[0].valid.assign(500, 1);
  std::fill_n(experiments[0].valid.begin() + 400, 20, 0);
  y.segment(400, 20).setZero();
  EXPECT_TRUE(hasLimit(experiments)) << "missing samples are no reading";
  y.segment(300, 6).setConstant(1.5);
  EXPECT_FALSE(hasLimit(experiments));
}

TEST(SampleChecks, ThreeRepeatsAreChance) {
  std::vector<Experiment> experiments = noise();
  for (int t : {10, 20, 30}) experiments[0].y[t] = experiments[0].y[t - 1];
  EXPECT_TRUE(checkSamples(experiments).empty());
}

TEST(SampleChecks, MissingSamplesCountForNothing) {
  std::vector<Experiment> experiments = noise();
  experiments[0].valid.assign(500, 1);
  for (int t = 100; t < 110; ++t) {
    experiments[0].y[t] = 99;
    experiments[0].valid[static_cast<std::size_t>(t)] = 0;
  }
  EXPECT_TRUE(checkSamples(experiments).empty());
  EXPECT_TRUE(checkSamples({}).empty());
}

/// Held-out experiments lose their stray readings as well; those that the user excludes stay.
TEST(SampleChecks, StrayReadingsAreMaskedEverywhereUnlessExcluded) {
  std::vector<Experiment> experiments = example1Experiments(4);
  for (Experiment& experiment : experiments)
    for (const int t : {50, 90}) experiment.y[t] += 20 * experiment.y.cwiseAbs().maxCoeff();
  const Split split{{experiments[0], experiments[1]}, {experiments[2], experiments[3]}, false};
  Configuration configuration;
  Split masked = split;
  const auto stray = maskStray(&configuration, &masked);
  ASSERT_TRUE(stray);
  EXPECT_EQ(stray->trait, Trait::outliers);
  for (const auto* part : {&masked.train, &masked.held})
    for (const Experiment& experiment : *part)
      EXPECT_EQ(experiment.validSamples(), experiment.samples() - 2);
  EXPECT_EQ(configuration.limits.max_stray, 0) << "what is left is none";
  EXPECT_EQ(maskSpoilt(stray, &configuration, &masked).size(), 1u);
  Configuration without;
  without.explanation.exclude = {"sens_outliers"};
  Split kept = split;
  EXPECT_FALSE(maskStray(&without, &kept));
  EXPECT_EQ(kept.train[0].validSamples(), kept.train[0].samples());
}

/// A limit of the sensor must not show as a curve; how long a machine rested may.
TEST(SampleChecks, TheFreeSimulationDoesNotSeeSpoiltSamples) {
  Split data;
  data.train = data.held = noise();
  for (Experiment& experiment : data.train) {
    experiment.y = experiment.y.cwiseMin(1.0);
    experiment.u.head(50).setZero();
    experiment.y.head(50).setZero();
  }
  data.held = data.train;
  const Split seen = withoutSpoiltSamples({}, data);
  for (const auto* part : {&seen.train, &seen.held})
    for (const Experiment& experiment : *part) {
      EXPECT_EQ(experiment.samples(), 500);
      EXPECT_TRUE(experiment.isValid(20));
      for (int t = 0; t < experiment.samples(); ++t)
        EXPECT_EQ(experiment.isValid(t), experiment.y[t] < 1);
    }
}

}  // namespace
}  // namespace uncertainty_identification
