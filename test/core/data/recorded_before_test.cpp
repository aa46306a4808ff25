#include "data/recorded_before.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

Experiment experimentAt(double start) {
  Experiment experiment;
  experiment.id = "run";
  experiment.start_time = start;
  experiment.sample_time = 0.1;
  experiment.u = Eigen::Vector3d(1, -1, 1);
  experiment.y = Eigen::Vector3d(0, 0.5, 0.25);
  return experiment;
}

TEST(RecordedBefore, RecognisesSameStampsAndSamplesWhateverTheId) {
  RecordedBefore before;
  EXPECT_TRUE(before.add(experimentAt(1)));
  Experiment again = experimentAt(1);
  again.id = "experiment_020";
  EXPECT_FALSE(before.add(again));
}

TEST(RecordedBefore, AnyOtherStampOrSampleIsAnotherExperiment) {
  RecordedBefore before;
  EXPECT_TRUE(before.add(experimentAt(1)));
  EXPECT_TRUE(before.add(experimentAt(2))) << "the same samples, later";
  Experiment other = experimentAt(1);
  other.y[2] = 0.26;
  EXPECT_TRUE(before.add(other));
  other.u[0] = 2;
  EXPECT_TRUE(before.add(other));
  other.sample_time = 0.2;
  EXPECT_TRUE(before.add(other));
}

TEST(RecordedBefore, ForgetsWhenCleared) {
  RecordedBefore before;
  before.add(experimentAt(1));
  before.clear();
  EXPECT_TRUE(before.add(experimentAt(1)));
}

TEST(RecordedBefore, WhatWasTakenOutComesBackOnlyWhenAskedFor) {
  RecordedBefore before;
  EXPECT_TRUE(before.readmit(experimentAt(1))) << "never recorded";
  before.add(experimentAt(1));
  EXPECT_FALSE(before.readmit(experimentAt(1))) << "still there";
  before.takeOut(experimentAt(1));
  EXPECT_FALSE(before.add(experimentAt(1))) << "the next pass of a loop";
  EXPECT_TRUE(before.readmit(experimentAt(1)));
  EXPECT_TRUE(before.add(experimentAt(1)));
  EXPECT_FALSE(before.readmit(experimentAt(1)));
}

TEST(RecordedBefore, RemembersTheNewest) {
  RecordedBefore before;
  for (std::size_t k = 0; k <= RecordedBefore::kRemembered; ++k)
    EXPECT_TRUE(before.add(experimentAt(static_cast<double>(k))));
  EXPECT_FALSE(before.add(experimentAt(1)));
  EXPECT_TRUE(before.add(experimentAt(0))) << "the oldest was forgotten";
}

}  // namespace
}  // namespace uncertainty_identification
