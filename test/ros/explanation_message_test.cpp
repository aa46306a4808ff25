#include "ros/explanation_message.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/example_explanation.h"
#include "uncertainty_identification/io/explanation_json.h"

namespace uncertainty_identification {
namespace {

using Message = messages::Explanation;

TEST(ExplanationMessage, HoldsWhatTheExplanationHolds) {
  const Message message = toMessage(test::exampleExplanation(), ros::Time(7, 0), 3);
  EXPECT_EQ(message.header.stamp, ros::Time(7, 0));
  EXPECT_EQ(message.sequence, 3U);
  EXPECT_EQ(message.verdict, Message::PARTLY_EXPLAINED);
  EXPECT_EQ(message.message, test::exampleExplanation().message);
  ASSERT_EQ(message.checks_before.size(), 3U);
  EXPECT_EQ(message.checks_before[0].name, "whiteness");
  EXPECT_EQ(message.checks_before[0].statistic, 812.5);
  EXPECT_EQ(message.checks_before[0].p_value, 1e-40);
  EXPECT_FALSE(message.checks_before[0].passed);
  EXPECT_EQ(message.checks_after[0].where, "8 to 9 rad/s");
  ASSERT_EQ(message.candidates.size(), 2U);
  EXPECT_EQ(message.candidates[1].variant, "temp");
  EXPECT_EQ(message.candidates[0].score, 412.5);
  EXPECT_EQ(message.candidates[0].held_out_gain, 12.25);
  EXPECT_EQ(message.candidates[0].standard_error, 1.0 / 3);
  EXPECT_EQ(message.held_out.size(), 2U);
  EXPECT_EQ(message.warnings.size(), 1U);
  EXPECT_EQ(message.seconds, 1.5);
}

TEST(ExplanationMessage, HoldsCausesWithParametersAndGain) {
  const Message message = toMessage(test::exampleExplanation(), ros::Time(), 0);
  ASSERT_EQ(message.causes.size(), 2U);
  const messages::Cause& cause = message.causes[0];
  EXPECT_EQ(cause.name, "act_deadzone");
  EXPECT_EQ(cause.group, "actuator");
  EXPECT_EQ(cause.description, "inputs smaller than the width have no effect");
  EXPECT_EQ(cause.confidence, 0.98);
  EXPECT_EQ(cause.equivalent, std::vector<std::string>{"act_backlash"});
  EXPECT_EQ(cause.advice, "move the actuator slowly through zero");
  EXPECT_EQ(cause.parameters[0].name, "width");
  EXPECT_EQ(cause.parameters[0].unit, "V");
  EXPECT_EQ(cause.parameters[0].value, 0.31);
  EXPECT_EQ(cause.parameters[0].standard_error, 0.004);
  EXPECT_EQ(cause.parameters[0].lower_90, 0.303);
  EXPECT_EQ(cause.parameters[0].upper_90, 0.317);
  EXPECT_TRUE(cause.has_gain);
  EXPECT_EQ(cause.gain, 12.25);
  EXPECT_EQ(cause.gain_standard_error, 1.0 / 3);
  const std::vector<double> compared{
      cause.fit_before,          cause.fit_after,          cause.coverage_50_before,
      cause.coverage_50_after,   cause.coverage_90_before, cause.coverage_90_after,
      cause.coverage_95_before,  cause.coverage_95_after,  cause.noise_variance_before,
      cause.noise_variance_after};
  EXPECT_EQ(compared,
            (std::vector<double>{81.2, 88.9, 0.45, 0.5, 0.8, 0.89, 0.91, 0.95, 0.13, 0.1}));
  EXPECT_EQ(cause.bode_area_before, 0.4);
  EXPECT_TRUE(std::isnan(cause.bode_area_after));
}

TEST(ExplanationMessage, HoldsPlaceShapeAndCurve) {
  const Message message = toMessage(test::exampleExplanation(), ros::Time(), 0);
  const messages::Cause& cause = message.causes[0];
  EXPECT_EQ(cause.place, "input");
  EXPECT_EQ(cause.shape, "dead_zone");
  EXPECT_EQ(cause.ties, std::vector<std::string>{"play: play"});
  EXPECT_EQ(cause.curve_of, "input");
  EXPECT_EQ(cause.curve_signal, (std::vector<double>{-1, 0, 1}));
  EXPECT_EQ(cause.curve_value, (std::vector<double>{-0.69, 0, 0.69}));
  EXPECT_EQ(cause.curve_lower_90, (std::vector<double>{-0.7, -0.01, 0.68}));
  EXPECT_EQ(cause.curve_upper_90, (std::vector<double>{-0.68, 0.01, 0.7}));
  EXPECT_TRUE(message.causes[1].place.empty());
  EXPECT_TRUE(message.causes[1].curve_signal.empty());
}

TEST(ExplanationMessage, WhatHasNoGainSaysSo) {
  const auto cause = toMessage(test::exampleExplanation(), ros::Time(), 0).causes[1];
  EXPECT_FALSE(cause.has_gain);
  EXPECT_TRUE(std::isnan(cause.gain));
  EXPECT_TRUE(std::isnan(cause.noise_variance_after));
}

TEST(ExplanationMessage, HoldsTheWholeAsJson) {
  const Message message = toMessage(test::exampleExplanation(), ros::Time(), 0);
  EXPECT_EQ(nlohmann::json::parse(message.explanation_json), toJson(test::exampleExplanation()));
  Explanation foreign = test::exampleExplanation();
  foreign.held_out[0] = "run\xff";
  EXPECT_NE(toMessage(foreign, ros::Time(), 0).explanation_json.find("run\xef\xbf\xbd"),
            std::string::npos);
}

TEST(ExplanationMessage, EveryVerdictHasItsCode) {
  Explanation explanation;
  for (const auto& [verdict, code] :
       {std::pair{Verdict::none, Message::NONE}, std::pair{Verdict::explained, Message::EXPLAINED},
        std::pair{Verdict::partly_explained, Message::PARTLY_EXPLAINED},
        std::pair{Verdict::unknown, Message::UNKNOWN}}) {
    explanation.verdict = verdict;
    EXPECT_EQ(toMessage(explanation, ros::Time(), 0).verdict, code);
  }
}

}  // namespace
}  // namespace uncertainty_identification
