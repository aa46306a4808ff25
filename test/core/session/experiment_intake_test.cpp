#include "session/experiment_intake.h"

#include <gtest/gtest.h>

#include <future>
#include <memory>

#include "support/wait_for.h"

namespace uncertainty_identification {
namespace {

/// A recording of `count` samples at this spacing [s].
Recording recordingOf(const std::string& id, double spacing, int count = 30) {
  Recording recording;
  recording.id = id;
  for (int k = 0; k < count; ++k) {
    const double stamp = 1 + spacing * k;
    recording.input.stamps.push_back(stamp);
    recording.input.values.push_back(k % 3);
    recording.output.stamps.push_back(stamp);
    recording.output.values.push_back(k % 5);
  }
  return recording;
}

/// An intake that keeps what it delivers. While `gate` is locked, it delivers nothing.
class IntakeTest : public testing::Test {
 protected:
  std::vector<LoadedData> delivered() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return delivered_;
  }

  bool waitUntilProcessed(int count) {
    return waitFor([&] { return processed_ == count && intake_->waiting() == 0; });
  }

  std::mutex gate_;
  std::mutex mutex_;
  std::vector<LoadedData> delivered_;
  std::atomic<int> processed_{0};
  std::unique_ptr<ExperimentIntake> intake_ = std::make_unique<ExperimentIntake>(
      Configuration(),
      [this](LoadedData data) {
        const std::lock_guard<std::mutex> gate(gate_);
        const std::lock_guard<std::mutex> lock(mutex_);
        delivered_.push_back(std::move(data));
      },
      [this] { ++processed_; });
};

TEST_F(IntakeTest, DeliversEveryKindInOrder) {
  Experiment complete;
  complete.id = "complete";
  intake_->add(recordingOf("recorded", 0.1));
  intake_->add(complete);
  intake_->add(RejectedExperiment{"rejected", "the clock went back"});
  intake_->add(recordingOf("empty", 0.1, 0));
  ASSERT_TRUE(waitUntilProcessed(4));
  const auto all = delivered();
  ASSERT_EQ(all.size(), 4U);
  ASSERT_EQ(all[0].experiments.size(), 1U);
  EXPECT_EQ(all[0].experiments[0].id, "recorded");
  EXPECT_EQ(all[0].experiments[0].samples(), 30);
  EXPECT_EQ(all[1].experiments.at(0).id, "complete");
  EXPECT_EQ(all[2].rejected.at(0).reason, "the clock went back");
  EXPECT_TRUE(all[3].experiments.empty());
  EXPECT_EQ(all[3].rejected.at(0).id, "empty");
}

TEST_F(IntakeTest, LaterRecordingsOfAboutTheSameRateGetTheFirstSampleTime) {
  intake_->add(recordingOf("first", 0.1));
  intake_->add(recordingOf("near", 0.101));
  intake_->add(recordingOf("other", 0.2));
  ASSERT_TRUE(waitUntilProcessed(3));
  const auto all = delivered();
  const double first = all[0].experiments.at(0).sample_time;
  EXPECT_EQ(all[1].experiments.at(0).sample_time, first);
  EXPECT_NEAR(all[2].experiments.at(0).sample_time, 0.2, 1e-6);
}

TEST_F(IntakeTest, TheFirstSampleTimeCanComeFromTheStore) {
  intake_->setFirstSampleTime(0.1);
  intake_->add(recordingOf("near", 0.101));
  ASSERT_TRUE(waitUntilProcessed(1));
  EXPECT_EQ(delivered()[0].experiments.at(0).sample_time, 0.1);
}

TEST_F(IntakeTest, AConfiguredSampleTimeAppliesToLaterExperiments) {
  intake_->add(recordingOf("before", 0.1));
  ASSERT_TRUE(waitUntilProcessed(1));
  Configuration configuration;
  configuration.sample_time = 0.2;
  intake_->configure(configuration);
  intake_->add(recordingOf("after", 0.1));
  ASSERT_TRUE(waitUntilProcessed(2));
  EXPECT_NEAR(delivered()[0].experiments.at(0).sample_time, 0.1, 1e-6);
  EXPECT_EQ(delivered()[1].experiments.at(0).sample_time, 0.2);
}

TEST_F(IntakeTest, AfterClearNothingOlderIsDelivered) {
  auto blocked = std::make_unique<std::lock_guard<std::mutex>>(gate_);
  for (int k = 0; k < 5; ++k) intake_->add(recordingOf("old", 0.1));
  auto cleared = std::async(std::launch::async, [this] {  // waits for the one being delivered
    intake_->clear();
    return delivered().size();
  });
  blocked.reset();
  const std::size_t before = cleared.get();
  EXPECT_LE(before, 5U);
  intake_->add(recordingOf("new", 0.2));
  ASSERT_TRUE(waitUntilProcessed(6)) << "dropped experiments are told as processed";
  const auto all = delivered();
  ASSERT_EQ(all.size(), before + 1);
  EXPECT_EQ(all.back().experiments.at(0).id, "new");
  EXPECT_NEAR(all.back().experiments.at(0).sample_time, 0.2, 1e-6)
      << "the first one's is forgotten";
}

TEST_F(IntakeTest, EndsOnlyOnceEverythingIsDelivered) {
  for (int k = 0; k < 20; ++k) intake_->add(recordingOf("run", 0.1));
  intake_.reset();
  EXPECT_EQ(delivered().size(), 20U);
}

}  // namespace
}  // namespace uncertainty_identification
