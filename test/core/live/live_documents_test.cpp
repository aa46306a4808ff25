#include "live/live_documents.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "session/result_overview.h"
#include "support/core_setup.h"
#include "support/example_explanation.h"
#include "support/plain_estimate.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

LiveStatus someStatus() {
  LiveStatus status;
  status.node.worker.busy = true;
  status.node.worker.queue = 2;
  status.node.running = {{"identifying from 12 experiments", 100}};
  status.node.sequence = 5;
  status.node.store_problem = "the disk is full";
  status.recorder = {true, {"y is silent"}};
  status.now = 103;
  return status;
}

TEST(LiveStatus, SaysWhatTheNodeDoesAndWhatIsWrong) {
  const Progress progress{"optimising", 0.25, {}};
  const json status = json::parse(liveStatus(someStatus(), &progress));
  EXPECT_EQ(status["state"], "identifying");
  EXPECT_EQ(status["recording"], true);
  EXPECT_EQ(status["problems"], json({"y is silent", "the disk is full"}));
  EXPECT_EQ(status["running"][0]["what"], "identifying from 12 experiments");
  EXPECT_EQ(status["running"][0]["seconds"], 3);
  EXPECT_EQ(status["waiting_experiments"], 2);
  EXPECT_EQ(status["progress"]["phase"], "optimising");
  EXPECT_EQ(status["progress"]["fraction"], 0.25);
}

TEST(LiveStatus, HasNoProgressWithoutAnIdentification) {
  LiveStatus status = someStatus();
  EXPECT_TRUE(json::parse(liveStatus(status, nullptr))["progress"].is_null());
  status.node.worker.busy = false;
  const Progress last{"standard errors", 1, {}};
  EXPECT_TRUE(json::parse(liveStatus(status, &last))["progress"].is_null());
}

// An event ends at the end of its line, and no byte of it may stop the page.
TEST(LiveStatus, IsOneLineOfUtf8) {
  LiveStatus status = someStatus();
  status.node.worker.message = "two\nlines and \xff";
  const std::string text = liveStatus(status, nullptr);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  EXPECT_NE(json::parse(text)["message"].get<std::string>().find("two\nlines"), std::string::npos);
}

TEST(LiveExperiments, ListsTheNewestFirstAndRejectedRecordingsApart) {
  std::vector<ExperimentDigest> experiments;
  for (int k = 0; k < 150; ++k)
    experiments.push_back({"run" + std::to_string(k), 1.0 * k, 0.1, 50, ""});
  experiments[149].rejected = "constant input";
  experiments[149].timing.input.lost = 3;
  experiments.push_back({"early", 0, 0, 0, "too short"});
  const json list = json::parse(liveExperiments(experiments));
  EXPECT_EQ(list["count"], 151);
  EXPECT_EQ(list["unused"], 2);
  ASSERT_EQ(list["kept"].size(), 100U);
  EXPECT_EQ(list["kept"][0]["id"], "run149");
  EXPECT_EQ(list["kept"][0]["reason"], "constant input");
  EXPECT_EQ(list["kept"][0]["lost"], 3);
  EXPECT_TRUE(list["kept"][0]["jitter"].is_null()) << "not known";
  EXPECT_EQ(list["kept"][99]["id"], "run50");
  ASSERT_EQ(list["rejected"].size(), 1U);
  EXPECT_EQ(list["rejected"][0]["reason"], "too short");
}

TEST(LiveResult, HoldsWhatAFirstPageReadsAndNotMuchMore) {
  Result result{test::plainEstimate(test::vectorOf({1.0}), test::vectorOf({-0.5})), {}};
  result.estimate.configuration.bounds.frequencies = 50;
  result.estimate.configuration.bounds.weight_order = 1;
  result.estimate.trust = {false, {"too few experiments"}};
  addOverview({}, &result);
  ResultContext context;
  context.sequence = 7;
  context.preliminary = true;
  const json without = json::parse(liveResult(result, context));
  EXPECT_EQ(without["sequence"], 7);
  EXPECT_EQ(without["preliminary"], true);
  EXPECT_EQ(without["physical"]["sentence"], result.physical.sentence);
  EXPECT_EQ(without["trust"]["reasons"][0], "too few experiments");
  EXPECT_EQ(without["bounds"], json::object());
  result.bounds = computeBounds(result.estimate);
  result.bounds->warnings = {"too narrow"};
  const std::string text = liveResult(result, context);
  EXPECT_EQ(json::parse(text)["bounds"], json({{"warnings", {"too narrow"}}}));
  EXPECT_LT(text.size(), 5000U) << "sent again with each result";
}

TEST(LiveExplanation, HoldsVerdictTestsAndCauses) {
  const json explanation = json::parse(liveExplanation(test::exampleExplanation()));
  EXPECT_EQ(explanation["verdict"], "partly_explained");
  EXPECT_EQ(explanation["causes"][0]["name"], "act_deadzone");
  EXPECT_EQ(explanation["checks_after"][0]["passed"], false);
  EXPECT_FALSE(explanation.contains("pictures"));
}

}  // namespace
}  // namespace uncertainty_identification
