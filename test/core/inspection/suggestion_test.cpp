#include "inspection/suggestion.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

/// A record of this length [s] and period [s].
Channel recordedChannel(double length, double period) {
  Channel channel;
  channel.records.resize(1);
  for (int k = 0; k * period <= length + 1e-9; ++k) {
    channel.records.front().stamps.push_back(100 + k * period);
    channel.records.front().values.push_back(k % 3);
  }
  return channel;
}

SignalChoice firstToSecond() {
  SignalChoice choice;
  choice.chosen = SignalPair{0, 1, {}, 1};
  return choice;
}

/// Two columns of a file.
Survey columnSurvey(const std::string& input, const std::string& output) {
  Survey survey;
  survey.records = 1;
  survey.channels = {recordedChannel(10, 0.1), recordedChannel(10, 0.1)};
  survey.channels[0].name = survey.channels[0].column = input;
  survey.channels[1].name = survey.channels[1].column = output;
  survey.times = {{"t", "s", false, ""}};
  return survey;
}

/// Two topics of a bag.
Survey topicSurvey(double length, double period) {
  Survey survey;
  survey.records = 1;
  survey.channels = {recordedChannel(length, period), recordedChannel(length, period)};
  survey.channels[0].topic = "/cmd";
  survey.channels[0].field = "linear.x";
  survey.channels[1].topic = "/odom";
  survey.channels[1].field = "twist.twist.linear.x";
  return survey;
}

Configuration suggestedFor(const Survey& survey, const Configuration& base = {}) {
  return suggestedConfiguration(survey, firstToSecond(), base);
}

void addTopic(const std::string& file, const std::string& name, const std::string& type,
              Survey& survey) {
  survey.streams.push_back({file, name, type, {}, {}, ""});
}

TEST(Suggestion, LeavesUAndYToTheReader) {
  const Configuration found = suggestedFor(columnSurvey("u", "y"));
  EXPECT_EQ(found.input.column, "");
  EXPECT_EQ(found.output.column, "");
  EXPECT_EQ(found.experiment.mode, ExperimentMode::topic) << "files are cut by their own rules";
}

TEST(Suggestion, NamesAnExchangedUAndY) {
  const Configuration found = suggestedFor(columnSurvey("y", "u"));
  EXPECT_EQ(found.input.column, "y");
  EXPECT_EQ(found.output.column, "u");
}

TEST(Suggestion, ReplacesAColumnThatIsStated) {
  Configuration base;
  base.input.column = "old";
  base.input.scale = 2;
  const Configuration found = suggestedFor(columnSurvey("u", "speed"), base);
  EXPECT_EQ(found.input.column, "u");
  EXPECT_EQ(found.input.scale, 2) << "the rest of the signal is kept";
  EXPECT_EQ(found.output.column, "speed");
}

TEST(Suggestion, TakesEachUnitOfTime) {
  Survey survey = columnSurvey("u", "y");
  for (const auto& [name, unit] : {std::pair{"s", TimeUnit::seconds},
                                   {"ms", TimeUnit::milliseconds},
                                   {"us", TimeUnit::microseconds},
                                   {"ns", TimeUnit::nanoseconds},
                                   {"index", TimeUnit::index}}) {
    survey.times.front().unit = name;
    EXPECT_EQ(suggestedFor(survey).time.unit, unit) << name;
  }
}

TEST(Suggestion, CountsRowsOfASecondUnlessTheSampleTimeIsKnown) {
  Survey survey = columnSurvey("u", "y");
  survey.times = {{"", "index", false, ""}};
  EXPECT_EQ(suggestedFor(survey).time.sample_time, 1);
  Configuration base;
  base.time.sample_time = 0.02;
  EXPECT_EQ(suggestedFor(survey, base).time.sample_time, 0.02);
}

TEST(Suggestion, LeavesTimesThatDifferBetweenFilesToTheReader) {
  Survey survey = columnSurvey("u", "y");
  survey.times.push_back({"time_ms", "ms", false, "run"});
  const Configuration found = suggestedFor(survey);
  EXPECT_EQ(found.time.column, "");
  EXPECT_EQ(found.time.unit, TimeUnit::automatic);
  EXPECT_EQ(found.experiment.column, "");
}

TEST(Suggestion, DoesNotNameAColumnCalledExperiment) {
  Survey survey = columnSurvey("u", "y");
  survey.times.front().experiments = "experiment";
  EXPECT_EQ(suggestedFor(survey).experiment.column, "");
  survey.times.front().experiments = "trial";
  EXPECT_EQ(suggestedFor(survey).experiment.column, "trial");
}

TEST(Suggestion, WithoutAPairStillTakesTheTime) {
  Survey survey = columnSurvey("a", "b");
  survey.times = {{"clock", "us", false, ""}};
  const Configuration found = suggestedConfiguration(survey, SignalChoice(), {});
  EXPECT_EQ(found.time.column, "clock");
  EXPECT_EQ(found.input.column, "") << "nothing is guessed";
  EXPECT_EQ(found.output.column, "");
}

TEST(Suggestion, NamesTopicsAndForgetsColumns) {
  Configuration base;
  base.input.column = "volt";
  const Configuration found = suggestedFor(topicSurvey(60, 0.1), base);
  EXPECT_EQ(found.input.topic, "/cmd");
  EXPECT_EQ(found.input.field, "linear.x");
  EXPECT_EQ(found.input.column, "");
  EXPECT_EQ(found.output.topic, "/odom");
  EXPECT_EQ(found.output.field, "twist.twist.linear.x");
}

TEST(Suggestion, CutsATenthOfTheRecordButAHundredSamplesAtLeast) {
  const auto window = [](double length, double period) {
    const Configuration found = suggestedFor(topicSurvey(length, period));
    EXPECT_EQ(found.experiment.mode, ExperimentMode::duration);
    return found.experiment.duration;
  };
  EXPECT_DOUBLE_EQ(window(120, 0.05), 10) << "12 s, rounded down to 1, 2 or 5";
  EXPECT_DOUBLE_EQ(window(290, 0.1), 20);
  EXPECT_DOUBLE_EQ(window(700, 0.5), 50);
  EXPECT_DOUBLE_EQ(window(130, 1), 100) << "a hundred samples, not 13";
  EXPECT_DOUBLE_EQ(window(60, 1), 61) << "a short record stays whole";
}

TEST(Suggestion, MeasuresTheTimeThatBothSignalsShare) {
  Survey survey = topicSurvey(1000, 0.5);
  for (double& stamp : survey.channels[1].records.front().stamps) stamp += 700;
  EXPECT_DOUBLE_EQ(suggestedFor(survey).experiment.duration, 50) << "of 300 s, not of 1000 s";
  survey.channels[1].records.front() = {};
  EXPECT_DOUBLE_EQ(suggestedFor(survey).experiment.duration, 1) << "none, but a valid one";
}

TEST(Suggestion, TakesTheOnlyTopicOfMarkers) {
  Survey survey = topicSurvey(60, 0.1);
  addTopic("a.bag", "/active", "uncertainty_identification/ExperimentMarker", survey);
  addTopic("b.bag", "/active", "uncertainty_identification/ExperimentMarker", survey);
  EXPECT_EQ(suggestedFor(survey).experiment.mode, ExperimentMode::topic);
  EXPECT_EQ(suggestedFor(survey).experiment.topic, "/active") << "the same one in both bags";
  addTopic("b.bag", "/emergency_stop", "std_msgs/Bool", survey);
  EXPECT_EQ(suggestedFor(survey).experiment.mode, ExperimentMode::duration)
      << "either could mark the experiments";
}

TEST(Suggestion, KeepsATopicOfMarkersThatIsStated) {
  Survey survey = topicSurvey(60, 0.1);
  addTopic("a.bag", "/active", "std_msgs/Bool", survey);
  Configuration base;
  base.experiment.topic = "/mine";
  EXPECT_EQ(suggestedFor(survey, base).experiment.topic, "/mine");
}

TEST(CutReason, SaysWhatDividesFilesOfColumns) {
  Survey survey = columnSurvey("u", "y");
  EXPECT_EQ(cutReason(survey, suggestedFor(survey)),
            "each file is one experiment; divided where the logger paused");
  survey.times.front().experiments = "run";
  EXPECT_EQ(cutReason(survey, suggestedFor(survey)),
            "the column 'run' names the experiments; divided where the logger paused");
}

TEST(CutReason, SaysWhatDividesTopics) {
  const Survey survey = topicSurvey(60, 0.1);
  Configuration configuration = suggestedFor(survey);
  EXPECT_EQ(cutReason(survey, configuration), "windows of 10 s, one after the other");
  configuration.experiment.mode = ExperimentMode::gap;
  configuration.experiment.gap = 2.5;
  EXPECT_EQ(cutReason(survey, configuration),
            "divided where nothing was recorded for more than 2.5 s");
  configuration.experiment.mode = ExperimentMode::topic;
  configuration.experiment.topic = "/run";
  EXPECT_EQ(cutReason(survey, configuration), "an experiment lasts while /run is true");
  configuration.experiment.mode = ExperimentMode::message;
  EXPECT_EQ(cutReason(survey, configuration), "the messages on /run are whole experiments");
}

}  // namespace
}  // namespace uncertainty_identification
