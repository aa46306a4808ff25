#include "data/experiment_checks.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace uncertainty_identification {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

Experiment good(const std::string& id, int samples = 50, std::uint64_t seed = 1) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Experiment experiment;
  experiment.id = id;
  experiment.sample_time = 0.1;
  experiment.start_time = 10;
  experiment.u = Eigen::VectorXd::NullaryExpr(samples, [&] { return normal(engine); });
  experiment.y = Eigen::VectorXd::NullaryExpr(samples, [&] { return normal(engine); });
  return experiment;
}

CheckReport check(const std::vector<Experiment>& experiments, double sample_time = 0) {
  return checkExperiments(experiments, {}, {}, sample_time);
}

/// Checks a bad experiment between two good ones: it alone is rejected, and the reason says what is
/// expected of it.
void expectRejected(const Experiment& bad, const std::string& part,
                    const std::vector<std::string>& required_covariates = {}) {
  std::vector<Experiment> experiments{good("first"), bad, good("last")};
  for (Experiment* each : {&experiments.front(), &experiments.back()}) each->scalars["load"] = 1;
  const CheckReport report = checkExperiments(experiments, {}, required_covariates, 0);
  EXPECT_EQ(report.usable, (std::vector<int>{0, 2}));
  ASSERT_EQ(report.rejected.size(), 1u);
  EXPECT_EQ(report.rejected[0].id, bad.id);
  const std::string& reason = report.rejected[0].reason;
  EXPECT_NE(reason.find("experiment '" + bad.id + "': "), std::string::npos) << reason;
  EXPECT_NE(reason.find(part), std::string::npos) << reason;
}

TEST(Check, GoodExperimentsPass) {
  const CheckReport report = check({good("a"), good("b", 80, 2)});
  EXPECT_EQ(report.usable, (std::vector<int>{0, 1}));
  EXPECT_TRUE(report.rejected.empty());
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_TRUE(check({}).usable.empty());
}

TEST(Check, Empty) {
  Experiment bad = good("bad", 0);
  expectRejected(bad, "it has no samples");
}

TEST(Check, OneSample) { expectRejected(good("bad", 1), "it has one sample only"); }

TEST(Check, FewerThanMinSamples) {
  expectRejected(good("bad", 19), "it has 19 measured samples, fewer than limits.min_samples 20");
  EXPECT_EQ(check({good("enough", 20)}).usable.size(), 1u);
  Experiment masked = good("masked", 25);
  masked.valid.assign(25, 1);
  for (std::size_t k = 0; k < 6; ++k) masked.valid[k] = 0;
  expectRejected(masked, "it has 19 measured samples");
}

TEST(Check, UnequalLengths) {
  Experiment bad = good("bad");
  bad.y.conservativeResize(49);
  expectRejected(bad, "50 samples of the input but 49 of the output");
  bad = good("bad");
  bad.valid.assign(51, 1);
  expectRejected(bad, "but 51 of valid");
  bad = good("bad");
  bad.signals["temp"] = Eigen::VectorXd::Ones(3);
  expectRejected(bad, "but 3 of covariate 'temp'");
  bad = good("bad");
  bad.stamp_offset = Eigen::VectorXd::Zero(2);
  expectRejected(bad, "but 2 of stamp_offset");
}

TEST(Check, NonFiniteInput) {
  Experiment bad = good("bad");
  bad.u(7) = kMissing;
  expectRejected(bad, "the input is nan at sample 7 (10.7 s), and NaN or infinite in 1 of");
  bad.u(7) = -std::numeric_limits<double>::infinity();
  expectRejected(bad, "the input is -inf at sample 7");
}

TEST(Check, NonFiniteOutputOnlyWhereMeasured) {
  Experiment bad = good("bad");
  bad.y(3) = kMissing;
  expectRejected(bad, "the output is nan at sample 3 (10.3 s)");
  bad.valid.assign(50, 1);
  bad.valid[3] = 0;
  EXPECT_EQ(check({bad}).usable.size(), 1u);
}

TEST(Check, ConstantInput) {
  Experiment bad = good("bad");
  bad.u.setZero();
  expectRejected(bad, "the input is constant (0)");
  bad.u.setConstant(2.5);
  EXPECT_EQ(defectOf(bad, {}), "") << "it depends on the others";
  const CheckReport alone = check({bad});
  ASSERT_EQ(alone.rejected.size(), 1u);
  EXPECT_NE(alone.rejected[0].reason.find("the input is constant (2.5)"), std::string::npos);
}

TEST(Check, AConstantInputIsOfUseBesideAnother) {
  Experiment low = good("low"), high = good("high"), off = good("off");
  low.u.setConstant(1);
  high.u.setConstant(2.5);
  off.u.setZero();
  const CheckReport report = check({low, high, off});
  EXPECT_EQ(report.usable, (std::vector<int>{0, 1}));
  ASSERT_EQ(report.rejected.size(), 1u);
  EXPECT_NE(report.rejected[0].reason.find("the input is constant (0)"), std::string::npos);
  ASSERT_GE(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("'low' and 1 other: the input is constant from the first"),
            std::string::npos)
      << report.warnings[0];
  Experiment same = good("same");
  same.u.setConstant(1);
  EXPECT_TRUE(check({low, same}).usable.empty());
  EXPECT_TRUE(check({low, off}).usable.empty()) << "the other one is not used either";
  EXPECT_EQ(checkExperiments({low}, {}, {}, 0, {high}).usable.size(), 1u);
  EXPECT_TRUE(checkExperiments({low}, {}, {}, 0, {same}).usable.empty());
}

TEST(Check, ConstantOutputWhereMeasured) {
  Experiment bad = good("bad");
  bad.y.setConstant(4);
  bad.y(5) = 9;
  EXPECT_EQ(check({bad}).usable.size(), 1u);
  bad.valid.assign(50, 1);
  bad.valid[5] = 0;
  expectRejected(bad, "the output is constant (4)");
}

TEST(Check, TooManyMissing) {
  Experiment bad = good("bad");
  bad.valid.assign(50, 1);
  for (std::size_t k = 0; k < 25; ++k) bad.valid[2 * k] = 0;
  EXPECT_EQ(check({bad}).usable.size(), 1u);  // one half is allowed
  bad.valid[1] = 0;
  expectRejected(
      bad, "26 of 50 output samples are missing, a share of 0.52 above limits.max_missing 0.5");
}

TEST(Check, AllMissing) {
  Experiment bad = good("bad");
  bad.valid.assign(50, 0);
  expectRejected(bad, "none of its");
}

TEST(Check, DuplicateIds) {
  const CheckReport report = check({good("same"), good("other"), good("same")});
  EXPECT_EQ(report.usable, (std::vector<int>{0, 1}));
  ASSERT_EQ(report.rejected.size(), 1u);
  EXPECT_NE(report.rejected[0].reason.find("an earlier experiment has the same id"),
            std::string::npos);
}

TEST(Check, TheOddSampleTimeIsRejected) {
  Experiment bad = good("bad");
  bad.sample_time = 0.05;
  expectRejected(bad, "its sample time is 0.05 s, but most experiments have 0.1 s");
  bad.sample_time = 0.1 * (1 + 2e-3);
  expectRejected(bad, "its sample time is 0.1002 s");
  bad.sample_time = 0.1 * (1 + 5e-4);
  EXPECT_EQ(check({good("a"), bad}).usable.size(), 2u);
}

TEST(Check, MoreSamplesDecideBetweenEquallyCommonSampleTimes) {
  Experiment slow = good("slow", 200);
  slow.sample_time = 0.2;
  EXPECT_EQ(check({good("fast"), slow}).usable, (std::vector<int>{1}));
  EXPECT_EQ(check({slow, good("fast")}).usable, (std::vector<int>{0}));
}

TEST(Check, AGivenSampleTimeDecides) {
  Experiment slow = good("slow");
  slow.sample_time = 0.2;
  const CheckReport report = check({good("a"), good("b"), slow}, 0.2);
  EXPECT_EQ(report.usable, (std::vector<int>{2}));
  EXPECT_NE(report.rejected[0].reason.find("sample_time is set to 0.2 s"), std::string::npos);
}

TEST(Check, SampleTimeMustBePositive) {
  for (const double sample_time : {0.0, -0.1, kMissing, std::numeric_limits<double>::infinity()}) {
    Experiment bad = good("bad");
    bad.sample_time = sample_time;
    expectRejected(bad, "it must be positive");
  }
}

TEST(Check, RejectedExperimentsHaveNoSayInTheSampleTime) {
  std::vector<Experiment> experiments{good("good")};
  for (const char* id : {"x", "y"}) {
    experiments.push_back(good(id));
    experiments.back().sample_time = 1;
    experiments.back().u.setZero();
  }
  EXPECT_EQ(check(experiments).usable, (std::vector<int>{0}));
}

TEST(Check, MissingCovariate) {
  expectRejected(good("bad"), "covariate 'load' is missing", {"load"});
  Experiment measured = good("measured");
  measured.signals["load"] = Eigen::VectorXd::LinSpaced(50, 0, 1);
  EXPECT_EQ(checkExperiments({measured}, {}, {"load"}, 0).usable.size(), 1u);
}

TEST(Check, NonFiniteCovariatesRejectOnlyWhereRequired) {
  Experiment bad = good("bad");
  bad.signals["load"] = Eigen::VectorXd::LinSpaced(50, 0, 1);
  bad.signals["load"](4) = kMissing;
  expectRejected(bad, "covariate 'load' is nan at sample 4", {"load"});
  const CheckReport report = check({bad});
  EXPECT_EQ(report.usable.size(), 1u);
  EXPECT_EQ(report.warnings.size(), 1u);
}

TEST(Check, SingleStepsAreWarnedOfWhenThereIsNothingElse) {
  std::vector<Experiment> steps{good("up"), good("down")};
  for (int i = 0; i < 2; ++i) {
    steps[static_cast<std::size_t>(i)].u.head(20).setConstant(i);
    steps[static_cast<std::size_t>(i)].u.tail(30).setConstant(1 - i);
  }
  const CheckReport report = check(steps);
  EXPECT_EQ(report.usable.size(), 2u);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("'up' and 1 other: the input changes only once"),
            std::string::npos);
  steps[1].u(49) = 5;
  EXPECT_TRUE(check(steps).warnings.empty());
}

TEST(Check, SeveralFindingsAreAllTold) {
  Experiment bad = good("bad");
  bad.u(0) = kMissing;
  bad.y.setZero();
  expectRejected(bad, "the input is nan");
  expectRejected(bad, "the output is constant");
}

TEST(Fingerprint, DependsOnWhatDeterminesTheFitAndNothingElse) {
  Experiment a = good("a");
  a.valid.assign(50, 1);
  a.valid[9] = 0;
  a.scalars["load"] = 1;
  a.signals["temp"] = Eigen::VectorXd::LinSpaced(50, 0, 1);
  const Experiment b = good("b", 60, 2);
  const std::string reference = dataFingerprint({a, b});
  EXPECT_EQ(reference.size(), 16u);
  EXPECT_EQ(reference.find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_EQ(dataFingerprint({b, a}), reference);

  Experiment same = a;
  same.id = "renamed";
  same.start_time = 0;
  same.y(9) = kMissing;  // not measured
  EXPECT_EQ(dataFingerprint({same, b}), reference);

  std::vector<Experiment> others(8, a);
  others[0].u(0) = std::nextafter(a.u(0), 1e9);
  others[1].y(1) = std::nextafter(a.y(1), 1e9);
  others[2].valid[9] = 1;
  others[3].valid[10] = 0;
  others[4].sample_time = 0.2;
  others[5].scalars["load"] = 2;
  others[6].signals["temp"](3) = 7;
  others[7].scalars = {{"lead", 1}};
  for (std::size_t i = 0; i < others.size(); ++i)
    EXPECT_NE(dataFingerprint({others[i], b}), reference) << i;
  EXPECT_NE(dataFingerprint({a, a, b}), reference);
  EXPECT_NE(dataFingerprint({a}), reference);
}

TEST(Fingerprint, AllValidIsTheSameAsNoMask) {
  Experiment masked = good("a");
  masked.valid.assign(50, 1);
  EXPECT_EQ(dataFingerprint({masked}), dataFingerprint({good("a")}));
}

TEST(Fingerprint, IsTheSameOnEveryMachine) {
  Experiment experiment;
  experiment.sample_time = 0.5;
  experiment.u = Eigen::Vector2d(1, 2);
  experiment.y = Eigen::Vector2d(3, 4);
  EXPECT_EQ(dataFingerprint({experiment}),
            "828b846ede514d2b");  // computed by another implementation
}

}  // namespace
}  // namespace uncertainty_identification
