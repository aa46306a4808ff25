#include "uncertainty_identification/data/recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/recording_setup.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using test::kNaN;
using test::ramp;
using test::random;
using test::recordingOf;

class UniformStamps
    : public testing::TestWithParam<std::tuple<OutputResampling, double, double, bool>> {};

TEST_P(UniformStamps, ComeBackBitByBit) {
  const auto [output, start, period, automatic] = GetParam();
  const Recording recording =
      recordingOf(random(start, period, 5000, 1), random(start, period, 5000, 2));
  ResamplingOptions options;
  options.output = output;
  ResamplingReport report;
  const Experiment experiment = resample(recording, automatic ? 0 : period, options, &report);
  ASSERT_EQ(experiment.samples(), 5000);
  for (int k = 0; k < 5000; ++k) {
    ASSERT_EQ(experiment.u(k), recording.input.values[static_cast<std::size_t>(k)]) << k;
    ASSERT_EQ(experiment.y(k), recording.output.values[static_cast<std::size_t>(k)]) << k;
  }
  EXPECT_EQ(experiment.start_time, start);
  EXPECT_NEAR(experiment.sample_time, period, 1e-8 * period);  // what stamps since 1970 resolve
  EXPECT_TRUE(experiment.valid.empty());
  EXPECT_EQ(experiment.stamp_offset.size(), 0);
  EXPECT_EQ(report.missing_outputs, 0);
  EXPECT_TRUE(report.warnings().empty());
}

INSTANTIATE_TEST_SUITE_P(AnyClock, UniformStamps,
                         testing::Combine(testing::Values(OutputResampling::hold,
                                                          OutputResampling::linear,
                                                          OutputResampling::mean),
                                          testing::Values(0.0, 0.1, 1000.0, 1.7e9),
                                          testing::Values(0.001, 0.01, 1.0 / 30, 0.0016384, 5.0),
                                          testing::Bool()));

TEST(Resample, AutomaticSampleTimeIsExactForDecimalPeriods) {
  for (const double period : {0.001, 0.01, 0.0016384, 0.04, 5.0}) {
    for (const double start : {0.0, 0.3, 1.7e9}) {
      const Recording recording =
          recordingOf(ramp(start, period, 4000, 0), ramp(start, period, 4000, 0));
      EXPECT_EQ(resample(recording, 0, {}).sample_time, period) << start;
    }
  }
}

TEST(Resample, StampsRoundedInPrintGiveThePeriodMeant) {
  StampedSignal signal = ramp(0, 0.0016384, 40000, 0);
  for (double& stamp : signal.stamps)
    stamp = std::round(stamp * 1e6) / 1e6;  // spacings 0.001638 and 0.001639
  const Experiment experiment = resample(recordingOf(signal, signal), 0, {});
  EXPECT_EQ(experiment.sample_time, 0.0016384);
  EXPECT_EQ(experiment.samples(), 40000);
  EXPECT_EQ(experiment.u, experiment.y);
}

TEST(Resample, JitterShiftsNoSampleAndIsKept) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> jitter(-0.002, 0.002);
  StampedSignal input = ramp(100, 0.01, 2000, 0), output = ramp(100, 0.01, 2000, 0);
  for (double& stamp : output.stamps) stamp += jitter(engine);
  ResamplingReport report;
  const Experiment experiment = resample(recordingOf(input, output), 0.01, {}, &report);
  ASSERT_EQ(experiment.samples(), 2000);
  EXPECT_EQ(experiment.u, experiment.y);  // sample i of the input goes with sample i of the output
  ASSERT_EQ(experiment.stamp_offset.size(), 2000);
  for (int k = 0; k < 2000; ++k) {
    const double nominal = experiment.start_time + 0.01 * k;
    EXPECT_NEAR(experiment.stamp_offset(k), output.stamps[static_cast<std::size_t>(k)] - nominal,
                1e-9);
  }
  EXPECT_NEAR(report.max_jitter, 0.002, 2e-4);
  EXPECT_EQ(report.warnings().size(), 1u);
  ResamplingOptions options;
  options.output = OutputResampling::linear;  // moves the values to the grid points instead
  EXPECT_EQ(resample(recordingOf(input, output), 0.01, options).stamp_offset.size(), 0);
}

TEST(Resample, IndependentJitterDoesNotShiftTheInput) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> jitter(-0.001, 0.001);
    StampedSignal input = ramp(100, 0.01, 500, 0), output = input;
    for (double& stamp : input.stamps) stamp += jitter(engine);
    for (double& stamp : output.stamps) stamp += jitter(engine);
    const Experiment experiment = resample(recordingOf(input, output), 0.01, {});
    EXPECT_EQ(experiment.u, experiment.y) << seed;
  }
}

TEST(Resample, SignalsStampedTogetherStayTogetherUnderJitterAndDrift) {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> jitter(-0.003, 0.003);
  StampedSignal signal = ramp(1.7e9, 0.010003, 3000, 0);
  for (double& stamp : signal.stamps) stamp += jitter(engine);
  for (const double sample_time : {0.0, 0.01, 0.010003}) {
    const Experiment experiment = resample(recordingOf(signal, signal), sample_time, {});
    EXPECT_EQ(experiment.u, experiment.y) << sample_time;
  }
}

TEST(Resample, TimersThatWanderKeepTheirPairs) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> late(0, 0.006);
  StampedSignal signal = ramp(0, 0.01, 2000, 0);
  double stamp = 0;
  for (double& each : signal.stamps)
    each = stamp += 0.01 + late(engine);  // sleeps after each turn: no fixed phase
  const Experiment experiment = resample(recordingOf(signal, signal), 0.013, {});
  EXPECT_EQ(experiment.u, experiment.y);
}

TEST(Resample, InputOfAnotherRateIsHeld) {
  // input at 0, 2.5, 5, ...; the grid follows the output
  const Experiment experiment =
      resample(recordingOf(ramp(0, 2.5, 10, 0), ramp(1, 1, 9, 100)), 1, {});
  ASSERT_EQ(experiment.samples(), 9);
  EXPECT_EQ(experiment.start_time, 1);
  const Eigen::VectorXd expected = (Eigen::VectorXd(9) << 0, 0, 1, 1, 2, 2, 2, 3, 3).finished();
  EXPECT_EQ(experiment.u, expected);  // at 5 s exactly, the sample of that instant counts
}

TEST(Resample, RareCommandsCountFromTheirStamps) {
  const StampedSignal steps{{0, 5.004, 10, 15, 20}, {0, 1, 2, 3, 4}};  // nearly periodic, by chance
  const Experiment experiment = resample(recordingOf(steps, ramp(0, 0.01, 2000, 0)), 0.01, {});
  EXPECT_EQ(experiment.u(500), 0);
  EXPECT_EQ(experiment.u(501), 1);
}

TEST(Resample, InputStampedAfterTheOutputIsTheOldOneStill) {
  const Experiment experiment =
      resample(recordingOf(ramp(0.3, 1, 20, 0), ramp(0, 1, 20, 0)), 1, {});
  ASSERT_EQ(experiment.samples(), 19);  // at 0 s the input is not known
  EXPECT_EQ(experiment.start_time, 1);
  EXPECT_EQ(experiment.y(0), 1);
  EXPECT_EQ(experiment.u(0), 0);
  EXPECT_EQ(experiment.u(18), 18);
}

TEST(Resample, InputBeforeTheStartIsInForceAtTheStart) {
  Recording recording = recordingOf({{-7, 4}, {5, 6}}, ramp(-2, 1, 12, 0));
  recording.start = 0;
  recording.end = 8;
  const Experiment experiment = resample(recording, 1, {});
  ASSERT_EQ(experiment.samples(), 8);  // start <= stamp < end
  EXPECT_EQ(experiment.start_time, 0);
  EXPECT_EQ(experiment.y(0), 2);
  EXPECT_EQ(experiment.u(0), 5);
  EXPECT_EQ(experiment.u(3), 5);
  EXPECT_EQ(experiment.u(4), 6);
}

TEST(Resample, SlowOutputIsHeldUpToMaxAge) {
  ResamplingOptions options;
  options.max_age = 2;
  const Experiment experiment =
      resample(recordingOf(ramp(0, 1, 21, 0), ramp(0, 5, 5, 100)), 1, options);
  ASSERT_EQ(experiment.samples(), 21);
  for (int k = 0; k < 21; ++k) {
    EXPECT_EQ(experiment.isValid(k), k % 5 <= 2) << k;
    if (k % 5 <= 2) {
      EXPECT_EQ(experiment.y(k), 100 + k / 5) << k;
    }
  }
}

TEST(Resample, GapsAreMissingBeyondThreeSampleTimes) {
  StampedSignal output = ramp(0, 0.1, 60, 0);
  output.stamps.erase(output.stamps.begin() + 20, output.stamps.begin() + 30);
  output.values.erase(output.values.begin() + 20, output.values.begin() + 30);
  for (const auto mode :
       {OutputResampling::hold, OutputResampling::linear, OutputResampling::mean}) {
    ResamplingOptions options;
    options.output = mode;
    ResamplingReport report;
    const Experiment experiment =
        resample(recordingOf(ramp(0, 0.1, 60, 0), output), 0.1, options, &report);
    ASSERT_EQ(experiment.samples(), 60);
    EXPECT_EQ(experiment.u(59), 59);
    EXPECT_EQ(experiment.y(59), 59);
    EXPECT_EQ(report.missing_outputs, mode == OutputResampling::hold ? 7 : 10);
    EXPECT_EQ(experiment.isValid(22), mode == OutputResampling::hold);
    EXPECT_FALSE(experiment.isValid(23));
    EXPECT_FALSE(report.warnings().empty());
  }
}

TEST(Resample, LinearInterpolatesBetweenStamps) {
  ResamplingOptions options;
  options.output = OutputResampling::linear;
  const Experiment experiment =
      resample(recordingOf(ramp(0, 1, 10, 0), ramp(0, 0.4, 20, 0)), 1, options);
  for (int k = 0; k < experiment.samples(); ++k) EXPECT_NEAR(experiment.y(k), k / 0.4, 1e-12) << k;
}

TEST(Resample, MeanAveragesTheBinAroundTheGridPoint) {
  ResamplingOptions options;
  options.output = OutputResampling::mean;
  const Experiment experiment =
      resample(recordingOf(ramp(0, 1, 5, 0), ramp(0, 0.25, 17, 0)), 1, options);
  ASSERT_EQ(experiment.samples(), 5);
  EXPECT_EQ(experiment.y(1), (2 + 3 + 4 + 5) / 4.0);  // 0.5 <= t < 1.5
  EXPECT_EQ(experiment.y(2), (6 + 7 + 8 + 9) / 4.0);
}

TEST(Resample, FasterOutputIsReadAtTheGridPoints) {
  const Experiment experiment =
      resample(recordingOf(ramp(0, 0.1, 50, 0), ramp(0, 0.01, 500, 0)), 0.1, {});
  ASSERT_EQ(experiment.samples(), 50);
  for (int k = 0; k < 50; ++k) EXPECT_EQ(experiment.y(k), 10 * k) << k;
}

TEST(Resample, NonFiniteOutputIsMissing) {
  StampedSignal output = ramp(0, 1, 30, 0);
  output.values[7] = kNaN;
  output.values[29] = std::numeric_limits<double>::infinity();
  const Experiment experiment = resample(recordingOf(ramp(0, 1, 30, 0), output), 1, {});
  ASSERT_EQ(experiment.samples(), 30);
  EXPECT_FALSE(experiment.isValid(7));
  EXPECT_FALSE(experiment.isValid(29));
  EXPECT_EQ(experiment.validSamples(), 28);
}

// As a simulation does that answers each measurement with the measurement's stamp.
TEST(Resample, ACovariateWithTheStampsOfTheOutputBelongsToItsSample) {
  Recording recording = recordingOf(ramp(0, 0.1, 100, 0), ramp(0, 0.1, 100, 7));
  for (std::size_t i = 0; i < 100; ++i)
    recording.output.stamps[i] += 0.01 * std::sin(static_cast<double>(i * i));
  recording.output.stamps[0] = 0;
  recording.covariates["sim"] = recording.output;
  recording.covariates["sim"].stamps.insert(recording.covariates["sim"].stamps.begin(), -5);
  recording.covariates["sim"].values.insert(recording.covariates["sim"].values.begin(), 1);
  const Experiment experiment = resample(recording, 0.1, {});
  ASSERT_GE(experiment.samples(), 98);
  EXPECT_EQ(experiment.signals.at("sim"), experiment.y);
}

TEST(Resample, ConstantCovariatesAreScalarsOthersSignals) {
  Recording recording = recordingOf(ramp(0, 1, 6, 0), ramp(0, 1, 6, 0));
  recording.covariates["once"] = {{3}, {42}};
  recording.covariates["constant"] = ramp(0, 1, 6, 0);
  for (double& value : recording.covariates["constant"].values) value = 1.5;
  recording.covariates["slow"] = {{1.5, 3}, {10, 11}};
  recording.covariates["silent"] = {};
  const Experiment experiment = resample(recording, 1, {});
  EXPECT_EQ(experiment.scalars, (std::map<std::string, double>{{"constant", 1.5}, {"once", 42}}));
  ASSERT_EQ(experiment.signals.size(), 1u);
  EXPECT_EQ(experiment.signals.at("slow"),
            (Eigen::VectorXd(6) << 10, 10, 10, 11, 11, 11).finished());
}

}  // namespace
}  // namespace uncertainty_identification
