#include "inspection/signal_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "inspection/suggestion.h"

namespace uncertainty_identification {
namespace {

constexpr int kSamples = 1200;

/// A random binary signal of this seed.
std::vector<double> binarySignal(unsigned seed) {
  std::vector<double> u;
  unsigned state = seed;
  double level = 1;
  for (int k = 0; k < kSamples; ++k) {
    state = 1664525U * state + 1013904223U;
    if (k % 5 == 0) level = state > 0x80000000U ? 1 : -1;
    u.push_back(level);
  }
  return u;
}

/// The answer of a lag of first order, with some noise.
std::vector<double> lagged(const std::vector<double>& u) {
  std::vector<double> y(u.size(), 0);
  for (std::size_t k = 1; k < u.size(); ++k)
    y[k] = 0.7 * y[k - 1] + u[k - 1] + 0.05 * std::sin(1.7 * static_cast<double>(k * k));
  return y;
}

/// A survey of one record. Names that begin with '/' are topic and field, others columns.
class SurveyMaker {
 public:
  SurveyMaker() { survey_.records = 1; }

  SurveyMaker& add(const std::string& name, const std::vector<double>& values) {
    Channel channel;
    channel.name = name;
    const auto blank = name.find(' ');
    if (name.front() == '/') {
      channel.topic = name.substr(0, blank);
      channel.field = name.substr(blank + 1);
    } else {
      channel.column = name;
    }
    channel.records.resize(1);
    for (std::size_t k = 0; k < values.size(); ++k)
      channel.records.front().stamps.push_back(0.01 * static_cast<double>(k));
    channel.records.front().values = values;
    survey_.channels.push_back(std::move(channel));
    return *this;
  }

  SignalChoice choose(const GivenSignals& given = {}) const {
    std::vector<SignalMeasures> measures;
    for (const Channel& channel : survey_.channels) measures.push_back(measure(channel));
    return chooseSignals(survey_, measures, given);
  }

  Survey survey_;
};

void expectPair(const SignalChoice& choice, std::size_t input, std::size_t output) {
  ASSERT_TRUE(choice.chosen) << choice.doubt;
  EXPECT_EQ(choice.chosen->input, input);
  EXPECT_EQ(choice.chosen->output, output);
}

const std::vector<double> kInput = binarySignal(5), kOther = binarySignal(77);

TEST(SignalChoice, IsSettledByNames) {
  SurveyMaker maker;
  maker.add("wheel_speed", lagged(kInput)).add("motor_voltage", kInput).add("x", kOther);
  const SignalChoice choice = maker.choose();
  expectPair(choice, 1, 0);
  EXPECT_EQ(choice.doubt, "");
  EXPECT_NE(choice.input_reason.find("voltage"), std::string::npos);
  EXPECT_NE(choice.output_reason.find("speed"), std::string::npos);
  EXPECT_TRUE(choice.chosen->following.outputFollows());
}

TEST(SignalChoice, PrefersColumnsCalledUAndY) {
  SurveyMaker maker;
  maker.add("u2", kOther).add("u", kInput).add("y2", lagged(kOther)).add("y", lagged(kInput));
  const SignalChoice choice = maker.choose();
  expectPair(choice, 1, 3);
  EXPECT_EQ(choice.doubt, "");
}

TEST(SignalChoice, SaysThatItCannotTellAndGuessesByWhatFollows) {
  SurveyMaker maker;
  maker.add("voltage_left", kOther).add("voltage_right", kInput).add("speed", lagged(kInput));
  const SignalChoice choice = maker.choose();
  expectPair(choice, 1, 2);
  EXPECT_NE(choice.doubt.find("'voltage_left', 'voltage_right'"), std::string::npos)
      << choice.doubt;
  EXPECT_EQ(choice.others.size(), 1u);
}

TEST(SignalChoice, WithoutNamesGoesByTheDirectionOfPrediction) {
  SurveyMaker maker;
  maker.add("a", lagged(kInput)).add("b", kInput);
  const SignalChoice choice = maker.choose();
  expectPair(choice, 1, 0);
  EXPECT_NE(choice.doubt.find("no signal that moves is called like an input"), std::string::npos);
}

TEST(SignalChoice, OfTopicsPairsTheSameComponents) {
  SurveyMaker maker;
  maker.add("/cmd_vel linear.x", kInput).add("/cmd_vel angular.z", kOther);
  maker.add("/odom pose.orientation.y", lagged(kOther));
  maker.add("/odom twist.twist.linear.x", lagged(kInput));
  expectPair(maker.choose(), 0, 3);
}

TEST(SignalChoice, TakesWhatIsGiven) {
  SurveyMaker maker;
  maker.add("voltage", kOther).add("a", kInput).add("speed", lagged(kInput));
  const SignalChoice choice = maker.choose({1, 2});
  expectPair(choice, 1, 2);
  EXPECT_EQ(choice.doubt, "");
  EXPECT_EQ(choice.input_reason, "the configuration says so");
}

TEST(SignalChoice, NeedsTwoSignalsThatMoveInOneRecord) {
  SurveyMaker maker;
  maker.add("u", kInput).add("y", std::vector<double>(kSamples, 4));
  EXPECT_FALSE(maker.choose().chosen);
  SurveyMaker apart;
  apart.add("u", kInput).add("y", lagged(kInput));
  apart.survey_.channels[0].records.push_back({});
  apart.survey_.channels[1].records.insert(apart.survey_.channels[1].records.begin(), {{}});
  EXPECT_FALSE(apart.choose().chosen);
  EXPECT_NE(apart.choose().doubt, "");
}

TEST(Suggestion, NamesColumnsAndTimeButNotUAndY) {
  SurveyMaker maker;
  maker.add("volt", kInput).add("y", lagged(kInput));
  maker.survey_.times = {{"time_ms", "ms", false, "run"}};
  const Configuration found = suggestedConfiguration(maker.survey_, maker.choose(), {});
  EXPECT_EQ(found.input.column, "volt");
  EXPECT_EQ(found.output.column, "") << "the reader takes y by itself";
  EXPECT_EQ(found.time.column, "time_ms");
  EXPECT_EQ(found.time.unit, TimeUnit::milliseconds);
  EXPECT_EQ(found.experiment.column, "run");
  EXPECT_EQ(found.experiment.mode, ExperimentMode::topic);
  EXPECT_NE(cutReason(maker.survey_, found).find("'run'"), std::string::npos);
}

TEST(Suggestion, LeavesAnAssumedUnitOpen) {
  SurveyMaker maker;
  maker.add("u", kInput).add("y", lagged(kInput));
  maker.survey_.times = {{"t", "s", true, ""}};
  const Configuration found = suggestedConfiguration(maker.survey_, maker.choose(), {});
  EXPECT_EQ(found.time.unit, TimeUnit::automatic) << "so that the reader warns of odd stamps";
}

TEST(Suggestion, CutsTopicsIntoWindowsUnlessAMarkerDoes) {
  SurveyMaker maker;
  maker.add("/cmd data", kInput).add("/speed data", lagged(kInput));
  Configuration found = suggestedConfiguration(maker.survey_, maker.choose(), {});
  EXPECT_EQ(found.input.topic, "/cmd");
  EXPECT_EQ(found.output.field, "data");
  EXPECT_EQ(found.experiment.mode, ExperimentMode::duration);
  EXPECT_DOUBLE_EQ(found.experiment.duration, 1);
  maker.survey_.streams.push_back({"a.bag", "/run", "std_msgs/Bool", {}, {}, ""});
  found = suggestedConfiguration(maker.survey_, maker.choose(), {});
  EXPECT_EQ(found.experiment.mode, ExperimentMode::topic);
  EXPECT_EQ(found.experiment.topic, "/run");
  maker.survey_.streams.push_back(
      {"a.bag", "/whole", "uncertainty_identification/Experiment", {}, {}, ""});
  found = suggestedConfiguration(maker.survey_, maker.choose(), {});
  EXPECT_EQ(found.experiment.mode, ExperimentMode::message);
  EXPECT_EQ(found.experiment.topic, "/whole");
}

TEST(Suggestion, KeepsTheCutThatIsGiven) {
  SurveyMaker maker;
  maker.add("/cmd data", kInput).add("/speed data", lagged(kInput));
  Configuration base;
  base.experiment.mode = ExperimentMode::gap;
  base.experiment.gap = 3;
  const Configuration found = suggestedConfiguration(maker.survey_, maker.choose(), base);
  EXPECT_EQ(found.experiment.mode, ExperimentMode::gap);
  EXPECT_EQ(found.experiment.gap, 3);
}

}  // namespace
}  // namespace uncertainty_identification
