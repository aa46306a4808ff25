#include "session/log_lines.h"

#include <gtest/gtest.h>

#include "support/example1.h"
#include "support/plain_estimate.h"

namespace uncertainty_identification {
namespace {

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

KeptExperiment keptExperiment() {
  return {1, std::make_shared<const Experiment>(example1Experiments(1).front())};
}

TEST(LogLines, AnExperimentIsAcceptedOrItIsSaidWhyNot) {
  LimitOptions limits;
  const KeptExperiment kept = keptExperiment();
  const std::string accepted = keptLine(kept, limits);
  EXPECT_TRUE(has(accepted, "'" + kept.experiment->id + "' has 100 samples")) << accepted;
  EXPECT_FALSE(has(accepted, "cannot")) << accepted;
  limits.min_samples = 101;
  EXPECT_TRUE(has(keptLine(kept, limits), "cannot be identified from: "));
  EXPECT_EQ(rejectedLine({"run", "it has no output"}),
            "experiment 'run' was rejected: it has no output");
}

TEST(LogLines, AResultTellsWhatChanged) {
  Estimate before =
      test::plainEstimate(Eigen::VectorXd::Constant(1, 1.0), Eigen::VectorXd::Constant(1, -0.5));
  before.experiment_count = 4;
  before.log_likelihood = 100;
  Estimate now = before;
  now.nominal_model.b[0] = 1.5;
  now.experiment_count = 5;
  now.log_likelihood = 130;
  now.termination = Termination::converged;
  const WorkerResult result{std::make_shared<const Estimate>(now), true, {}, {}};
  const std::string first = resultLine(result, 3, nullptr), next = resultLine(result, 3, &before);
  EXPECT_TRUE(has(first, "result 3 (quick update): converged")) << first;
  EXPECT_FALSE(has(first, "before")) << first;
  EXPECT_TRUE(has(next, "experiments 5 (before 4)")) << next;
  EXPECT_TRUE(has(next, "log-likelihood 130 (before 100)")) << next;
  EXPECT_TRUE(has(next, "static gain 3 (before 2)")) << next;
}

TEST(LogLines, WhatCouldNotBeWrittenIsNamed) {
  EXPECT_TRUE(
      has(unwrittenLine({"experiment 'a'", "the result"}), "lost: experiment 'a', the res"));
  EXPECT_TRUE(has(unwrittenLine(std::vector<std::string>(23, "x")), "and 3 more"));
}

TEST(StoreLog, HasALineWhenTheDiskBeginsToRefuseAndOneWhenThatEnds) {
  StoreLog log;
  StoreStatus status;
  EXPECT_FALSE(log.line(status));
  status.failing = true;
  status.message = "the disk is full";
  EXPECT_EQ(log.line(status), "the disk is full");
  EXPECT_FALSE(log.line(status)) << "the same again";
  status.failing = false;
  status.message.clear();
  EXPECT_TRUE(has(log.line(status).value_or(""), "can be written again"));
  EXPECT_FALSE(log.line(status));
  status.lost = 1;
  status.message = "1 files were given up";
  EXPECT_EQ(log.line(status), status.message);
  status.lost = 2;
  EXPECT_FALSE(log.line(status));
}

}  // namespace
}  // namespace uncertainty_identification
