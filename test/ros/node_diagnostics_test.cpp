#include "ros/node_diagnostics.h"

#include <gtest/gtest.h>

#include "ros/counted_queue.h"

namespace uncertainty_identification {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;
using Status = diagnostic_updater::DiagnosticStatusWrapper;

TopicActivity flowing(TopicRole role, const std::string& key) {
  return {"/" + key, key, role, 1000, 0, 0, 100.0, 0.01, 0.01};
}

std::vector<TopicActivity> flowing() {
  return {flowing(TopicRole::input, "input"),
          flowing(TopicRole::output, "output"),
          flowing(TopicRole::covariate, "temperature"),
          {"/active", "experiment.topic"}};
}

Status signals(const std::vector<TopicActivity>& topics, bool experiment_runs) {
  Status status;
  diagnoseSignals(topics, experiment_runs, status);
  return status;
}

int level(const std::vector<TopicActivity>& topics, bool experiment_runs) {
  return signals(topics, experiment_runs).level;
}

std::string valueOf(const Status& status, const std::string& key) {
  for (const auto& value : status.values)
    if (value.key == key) return value.value;
  return "no " + key;
}

TEST(DiagnoseSignals, OkWhereAllArrives) {
  EXPECT_EQ(level(flowing(), false), Level::OK);
  const Status status = signals(flowing(), true);
  EXPECT_EQ(status.level, Level::OK);
  EXPECT_EQ(valueOf(status, "input rate [Hz]"), "100");
  EXPECT_EQ(valueOf(status, "output age [s]"), "0.01");
}

TEST(DiagnoseSignals, StaleBeforeTheFirstMessageAndAnErrorInAnExperiment) {
  for (const std::size_t signal : {0U, 1U}) {
    auto topics = flowing();
    topics[signal].messages = 0;
    EXPECT_EQ(level(topics, false), Level::STALE);
    EXPECT_EQ(level(topics, true), Level::ERROR);
    EXPECT_NE(signals(topics, true).message.find(topics[signal].topic), std::string::npos);
  }
}

TEST(DiagnoseSignals, SilenceIsToldAfterThreeIntervals) {
  auto topics = flowing();
  topics[1].age = 2.1;
  EXPECT_EQ(level(topics, false), Level::WARN);
  EXPECT_EQ(level(topics, true), Level::ERROR);
  topics[1].interval = 1;  // a sensor of 1 Hz
  EXPECT_EQ(level(topics, true), Level::OK);
  topics[1].age = 3.1;
  EXPECT_EQ(level(topics, true), Level::ERROR);
}

TEST(DiagnoseSignals, AHeldInputAndAMissingCovariateAreWarnings) {
  auto topics = flowing();
  topics[0].age = 60;
  EXPECT_EQ(level(topics, true), Level::WARN);
  topics = flowing();
  topics[2].messages = 0;
  EXPECT_EQ(level(topics, true), Level::WARN);
}

TEST(DiagnoseSignals, MessagesLeftOutAreAWarning) {
  auto topics = flowing();
  topics[1].left_out = 3;
  const Status status = signals(topics, false);
  EXPECT_EQ(status.level, Level::WARN);
  EXPECT_NE(status.message.find("3 messages of output (/output)"), std::string::npos)
      << status.message;
}

TEST(DiagnoseIdentification, EachLevel) {
  const auto level = [](const WorkerStatus& worker) {
    Status status;
    diagnoseIdentification(worker, status);
    return static_cast<int>(status.level);
  };
  WorkerStatus worker;
  EXPECT_EQ(level(worker), Level::STALE);
  worker.termination = Termination::converged;
  EXPECT_EQ(level(worker), Level::OK);
  worker.queue = 11;
  EXPECT_EQ(level(worker), Level::WARN);
  worker.queue = 0;
  worker.trust = {false, {"the residuals are not white"}};
  EXPECT_EQ(level(worker), Level::WARN);
  worker.trust = {};
  worker.termination = Termination::iteration_limit;
  EXPECT_EQ(level(worker), Level::WARN);
  worker.failed = true;
  EXPECT_EQ(level(worker), Level::ERROR);
}

TEST(DiagnoseTiming, TellsOfTheNewestExperiment) {
  const auto diagnosed = [](const WorkerStatus& worker) {
    Status status;
    diagnoseTiming(worker, status);
    return status;
  };
  WorkerStatus worker;
  EXPECT_EQ(diagnosed(worker).level, Level::STALE);
  worker.last_id = "run";
  worker.timing.input.delay = 0.3;
  worker.timing.output.delay = 0.1;
  worker.timing.output.jitter = 0.001;
  EXPECT_EQ(diagnosed(worker).level, Level::OK);
  EXPECT_EQ(valueOf(diagnosed(worker), "clock offset [s]"), "0.2");
  EXPECT_EQ(valueOf(diagnosed(worker), "output jitter [s]"), "0.001");
  EXPECT_EQ(valueOf(diagnosed(worker), "input age of the newest sample [s]"), "nan");
  worker.timing.output.lost = 3;
  EXPECT_EQ(diagnosed(worker).level, Level::WARN);
  EXPECT_NE(diagnosed(worker).message.find("3 messages of the output were lost"),
            std::string::npos);
}

TEST(DiagnoseSignals, TellsOfSamplesThatAreNotFinite) {
  auto topics = flowing();
  topics[1].not_finite = 4;
  EXPECT_EQ(level(topics, false), Level::WARN);
  EXPECT_NE(signals(topics, false).message.find("4 samples of output (/output) were not finite"),
            std::string::npos);
}

TEST(DiagnoseActivity, NamesWhatRunsAndForHowLong) {
  Status status;
  diagnoseActivity({}, 0, 100, status);
  EXPECT_EQ(status.message, "nothing is being computed");
  Status busy;
  diagnoseActivity({{"answering ~identify", 90}, {"computing bounds", 99}}, 2, 100, busy);
  EXPECT_EQ(busy.level, Level::OK);
  EXPECT_EQ(busy.message, "answering ~identify; computing bounds");
  EXPECT_EQ(valueOf(busy, "answering ~identify for [s]"), "10");
  EXPECT_EQ(valueOf(busy, "waiting requests"), "2");
}

TEST(DiagnoseStore, TellsWhatTheDiskRefuses) {
  const auto diagnosed = [](const StoreStatus& store) {
    Status status;
    diagnoseStore(store, status);
    return status;
  };
  StoreStatus store;
  EXPECT_EQ(diagnosed(store).level, Level::OK);
  store.pending = 101;
  EXPECT_EQ(diagnosed(store).level, Level::WARN);
  store.message = "the store: no space left";
  EXPECT_EQ(diagnosed(store).level, Level::ERROR);
  EXPECT_EQ(diagnosed(store).message, store.message);
}

TEST(CountedQueue, CountsWhatWaits) {
  class Nothing : public ros::CallbackInterface {
    CallResult call() override { return Success; }
  };
  CountedQueue queue;
  EXPECT_EQ(queue.waiting(), 0);
  for (const std::uint64_t owner : {1, 2, 3})
    queue.addCallback(boost::make_shared<Nothing>(), owner);
  EXPECT_EQ(queue.waiting(), 3);
  queue.callOne();
  EXPECT_EQ(queue.waiting(), 2);
  queue.removeByID(2);
  EXPECT_EQ(queue.waiting(), 1) << "its caller has gone";
  queue.callAvailable();
  EXPECT_EQ(queue.waiting(), 0);
}

TEST(ArrivalCounter, GivesRatesSinceTheLastCallAndSmoothedIntervals) {
  using std::chrono::milliseconds;
  ArrivalCounter counter;
  auto now = ArrivalCounter::Clock::now();
  TopicActivity activity;
  counter.fillIn(activity, now);
  EXPECT_EQ(activity.messages, 0);
  EXPECT_TRUE(std::isinf(activity.age));
  for (int k = 0; k < 100; ++k) counter.count(now += milliseconds(10));
  counter.fillIn(activity, now += milliseconds(1000));
  EXPECT_EQ(activity.messages, 100);
  EXPECT_NEAR(activity.rate, 50, 1e-6);
  EXPECT_NEAR(activity.age, 1, 1e-9);
  EXPECT_NEAR(activity.interval, 0.01, 1e-9);
  counter.fillIn(activity, now += milliseconds(1000));
  EXPECT_EQ(activity.rate, 0);
}

}  // namespace
}  // namespace uncertainty_identification
