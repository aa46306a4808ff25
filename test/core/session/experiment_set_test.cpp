#include "session/experiment_set.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

Experiment makeExperiment(const std::string& id, double start, int samples = 11) {
  Experiment experiment;
  experiment.id = id;
  experiment.start_time = start;
  experiment.sample_time = 0.1;
  experiment.u = experiment.y = Eigen::VectorXd::Zero(samples);
  return experiment;
}

std::vector<std::string> idsOf(const ExperimentSet& set) {
  std::vector<std::string> ids;
  for (const auto& digest : set.digests()) ids.push_back(digest.id);
  return ids;
}

using Ids = std::vector<std::string>;

TEST(ExperimentSet, KeepsTheNewest) {
  LimitOptions limits;
  limits.max_experiments = 2;
  ExperimentSet set(limits);
  set.add({{makeExperiment("a", 0), makeExperiment("b", 2)}, {}, {}});
  set.add({{makeExperiment("c", 4)}, {}, {}});
  EXPECT_EQ(idsOf(set), (Ids{"b", "c"}));
}

Experiment usableExperiment(const std::string& id, double start) {
  Experiment experiment = makeExperiment(id, start, 30);
  experiment.u[3] = experiment.y[4] = 1;
  return experiment;
}

TEST(ExperimentSet, WhatCannotBeUsedTakesNoPlaceOfWhatCan) {
  LimitOptions limits;
  limits.max_experiments = 2;
  ExperimentSet set(limits);
  for (const double start : {0, 10, 20}) {
    const std::string number = std::to_string(static_cast<int>(start) / 10);
    set.add({{usableExperiment("good" + number, start)}, {}, {}});
    set.add({{makeExperiment("constant" + number, start + 5)}, {}, {}});
  }
  set.add({{makeExperiment("constant3", 30)}, {}, {}});
  EXPECT_EQ(idsOf(set), (Ids{"good1", "good2", "constant2", "constant3"}));
  EXPECT_EQ(set.digests()[0].rejected, "");
  EXPECT_NE(set.digests()[2].rejected.find("the input is constant"), std::string::npos);
  limits.min_samples = 31;  // nothing can be used any more
  set.setLimits(limits);
  EXPECT_EQ(idsOf(set), (Ids{"constant2", "constant3"}));
}

TEST(ExperimentSet, WhatWasRejectedComesBackOnRequestOnly) {
  ExperimentSet set{LimitOptions()};
  set.add({{makeExperiment("a", 0)}, {}, {}});
  EXPECT_FALSE(set.readmit(makeExperiment("a", 0)));
  set.reject("a", "the rig was touched");
  EXPECT_TRUE(set.add({{makeExperiment("a", 0)}, {}, {}}).empty());
  EXPECT_TRUE(set.readmit(makeExperiment("a", 0)));
  EXPECT_EQ(set.add({{makeExperiment("a", 0)}, {}, {}}).size(), 1U);
}

TEST(ExperimentSet, IdsDiffer) {
  ExperimentSet set{LimitOptions()};
  set.add({{makeExperiment("a", 0), makeExperiment("a", 2), makeExperiment("a", 4)}, {}, {}});
  EXPECT_EQ(idsOf(set), (Ids{"a", "a_2", "a_3"}));
}

TEST(ExperimentSet, WhatComesAgainCountsOnce) {
  LimitOptions limits;
  limits.max_experiments = 2;
  ExperimentSet set(limits);
  const auto shared = std::make_shared<const Experiment>(makeExperiment("a", 0));
  set.restore({{1, shared}}, {}, 1);
  EXPECT_TRUE(set.add({{makeExperiment("a", 0)}, {}, {}}).empty());
  EXPECT_EQ(set.add({{makeExperiment("b", 2), makeExperiment("c", 4)}, {}, {}}).size(), 2U);
  EXPECT_TRUE(set.add({{makeExperiment("a", 0)}, {}, {}}).empty()) << "no longer among the newest";
  EXPECT_EQ(idsOf(set), (Ids{"b", "c"}));
  set.clear();
  EXPECT_EQ(set.add({{makeExperiment("a", 0)}, {}, {}}).size(), 1U);
}

TEST(ExperimentSet, NumbersRiseWhateverIsTakenOut) {
  ExperimentSet set{LimitOptions()};
  const auto shared = std::make_shared<const Experiment>(makeExperiment("a", 0));
  set.restore({{7, shared}}, {{"x", "why"}}, 9);
  EXPECT_EQ(set.add({{makeExperiment("b", 1)}, {}, {}}).front().number, 10U);
  EXPECT_EQ(set.reject("a", "the rig was touched"), 7U);
  EXPECT_FALSE(set.reject("a", "again"));
  EXPECT_EQ(idsOf(set), (Ids{"b", "x", "a"}));
  set.clear();
  EXPECT_TRUE(set.digests().empty());
  EXPECT_EQ(set.add({{makeExperiment("b", 1)}, {}, {}}).front().number, 11U);
}

TEST(ExperimentSet, ListsTheRejectedOnesWithTheirReasons) {
  ExperimentSet set{LimitOptions()};
  set.add({{makeExperiment("a", 3)}, {{"b", "too short"}}, {}});
  const auto digests = set.digests();
  ASSERT_EQ(digests.size(), 2U);
  EXPECT_EQ(digests[0].start, 3);
  EXPECT_EQ(digests[0].samples, 11);
  EXPECT_EQ(digests[1].rejected, "too short");
}

TEST(ExperimentWindow, SpansAllExperiments) {
  const auto window = windowOf({makeExperiment("a", 5), makeExperiment("b", 2, 101)});
  EXPECT_EQ(window.count, 2);
  EXPECT_EQ(window.first_id, "a");
  EXPECT_EQ(window.last_id, "b");
  EXPECT_EQ(window.start, 2);
  EXPECT_DOUBLE_EQ(window.end, 12);
  EXPECT_EQ(windowOf({}).end, 0);
}

}  // namespace
}  // namespace uncertainty_identification
