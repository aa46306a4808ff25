#include "uncertainty_identification/data/loaded_data.h"

#include <gtest/gtest.h>

#include <random>

namespace uncertainty_identification {
namespace {

Recording jittering(const std::string& id, double period, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::uniform_real_distribution<double> jitter(-0.1, 0.1);
  Recording recording;
  recording.id = id;
  for (int k = 0; k < 40; ++k) {
    recording.input.stamps.push_back(period * (k + jitter(engine)));
    recording.input.values.push_back(k);
  }
  recording.output = recording.input;
  return recording;
}

TEST(LoadedData, BadRecordingsAreListedAndLoseNoOther) {
  Recording bad = jittering("bad", 0.1, 1);
  bad.output = {};
  Recording noted = jittering("noted", 0.1, 2);
  noted.note = "it was closed early";
  LoadedData data;
  for (const Recording& recording : {jittering("first", 0.1, 3), bad, noted}) {
    addResampled(recording, 0.1, {}, data);
  }
  ASSERT_EQ(data.experiments.size(), 2u);
  EXPECT_EQ(data.experiments[1].id, "noted");
  ASSERT_EQ(data.rejected.size(), 1u);
  EXPECT_EQ(data.rejected[0].id, "bad");
  EXPECT_NE(data.rejected[0].reason.find("output has no samples"), std::string::npos);
  EXPECT_EQ(data.warnings.back(), "experiment 'noted': it was closed early");
}

TEST(LoadedData, ShortJitteringRecordingsOfOneRateShareTheirSampleTime) {
  LoadedData data;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    addResampled(jittering("experiment", 1.0 / 30, seed), 0, {}, data);
  }
  for (const Experiment& experiment : data.experiments) {
    EXPECT_EQ(experiment.sample_time, data.experiments.front().sample_time);
    EXPECT_EQ(experiment.u, experiment.y);
  }
  addResampled(jittering("slower", 1.0 / 20, 1), 0, {}, data);
  EXPECT_NEAR(data.experiments.back().sample_time, 0.05, 1e-3);
}

TEST(LoadedData, Appends) {
  LoadedData data, more;
  data.warnings = {"a"};
  more.warnings = {"b"};
  more.rejected = {{"x", "y"}};
  more.experiments.resize(2);
  append(more, data);
  append(more, data);
  EXPECT_EQ(data.warnings, (std::vector<std::string>{"a", "b", "b"}));
  EXPECT_EQ(data.rejected.size(), 2u);
  EXPECT_EQ(data.experiments.size(), 4u);
}

TEST(SampleTimeForAll, IsTheLongestOfFew) {
  std::vector<Experiment> all(3);
  for (Experiment& experiment : all) experiment.sample_time = 0.1;
  EXPECT_EQ(sampleTimeForAll(all), 0);
  all[1].sample_time = 0.101;
  EXPECT_EQ(sampleTimeForAll(all), 0.1) << "jitter: that of most";
  all[1].sample_time = 0.10005;
  EXPECT_EQ(sampleTimeForAll(all), 0) << "as good as equal";
  all[1].sample_time = 0.3;
  EXPECT_EQ(sampleTimeForAll(all), 0.3);
  all[1].sample_time = 10;
  EXPECT_EQ(sampleTimeForAll(all), 0) << "a mistake, which the checks refuse";
  EXPECT_EQ(sampleTimeForAll({}), 0);
}

TEST(SampleTimeForAll, LeavesASlowFifthToTheChecks) {
  std::vector<Experiment> all(10);
  for (Experiment& experiment : all) experiment.sample_time = 0.01;
  all[3].sample_time = all[7].sample_time = 0.2;
  EXPECT_EQ(sampleTimeForAll(all), 0) << "the other eight go together as they are";
  all[5].sample_time = 0.2;
  EXPECT_EQ(sampleTimeForAll(all), 0.2);
  all[3].sample_time = 0.25;
  EXPECT_EQ(sampleTimeForAll(all), 0.2) << "all but the slowest";
  all[3].sample_time = 0.205;
  EXPECT_EQ(sampleTimeForAll(all), 0.205) << "one that is little slower is not lost";
}

}  // namespace
}  // namespace uncertainty_identification
