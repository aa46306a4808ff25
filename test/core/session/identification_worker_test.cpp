#include "session/identification_worker.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <stdexcept>

#include "support/example1.h"
#include "support/wait_for.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// A worker, and what it told.
class Fixture {
 public:
  explicit Fixture(const Configuration& configuration = example1Configuration())
      : worker(configuration, {[this](const WorkerResult& result) {
                                 const std::lock_guard<std::mutex> lock(mutex_);
                                 results_.push_back(result);
                               },
                               [this](const KeptExperiment& experiment) {
                                 const std::lock_guard<std::mutex> lock(mutex_);
                                 kept_.push_back(experiment);
                               },
                               [](const RejectedExperiment&) {},
                               [this] {
                                 ++changes;
                                 told_busy = worker.status().busy;
                               },
                               [this](const std::string& warning) {
                                 const std::lock_guard<std::mutex> lock(mutex_);
                                 warnings_.push_back(warning);
                               },
                               [](const std::string&) { return nullptr; },
                               [this](const Progress&) { ++progress; }}) {}

  std::vector<WorkerResult> results() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return results_;
  }

  std::vector<KeptExperiment> kept() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return kept_;
  }

  std::vector<std::string> warnings() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return warnings_;
  }

  bool waitUntilIdle() {
    return waitFor([this] { return !worker.status().busy; });
  }

 private:
  mutable std::mutex mutex_;
  std::vector<WorkerResult> results_;
  std::vector<KeptExperiment> kept_;
  std::vector<std::string> warnings_;

 public:
  std::atomic<int> changes{0}, progress{0};
  std::atomic<bool> told_busy{false};  // by the status after the last change
  IdentificationWorker worker;
};

void expectSame(const Estimate& actual, const Estimate& expected) {
  EXPECT_EQ(actual.data_fingerprint, expected.data_fingerprint);
  EXPECT_EQ(actual.log_likelihood, expected.log_likelihood);
  EXPECT_EQ(actual.nominal_model.b, expected.nominal_model.b);
  EXPECT_EQ(actual.nominal_model.a, expected.nominal_model.a);
  EXPECT_EQ(actual.noise_variance.value, expected.noise_variance.value);
  ASSERT_EQ(actual.error_model.mixture.components(), expected.error_model.mixture.components());
  EXPECT_EQ(actual.error_model.mixture.means.front(), expected.error_model.mixture.means.front());
}

TEST(IdentificationWorker, LastResultIsThatOfIdentifyingAllAtOnce) {
  const auto experiments = example1Experiments(12);
  Fixture fixture;
  for (const auto& experiment : experiments) {
    fixture.worker.add(experiment);
    if (experiment.id == experiments[7].id) {
      ASSERT_TRUE(fixture.waitUntilIdle());
    }
  }
  ASSERT_TRUE(fixture.waitUntilIdle());
  const auto results = fixture.results();
  ASSERT_GE(results.size(), 2U);
  EXPECT_FALSE(results.back().preliminary);
  EXPECT_EQ(results.back().estimate->experiment_count, 12);
  EXPECT_EQ(results.back().window.start, experiments.front().start_time);
  EXPECT_EQ(results.back().kept.size(), 12U);
  EXPECT_EQ(results.back().rejected, 0);
  expectSame(*results.back().estimate, Identifier(example1Configuration()).identify(experiments));
  EXPECT_GT(std::count_if(results.begin(), results.end(),
                          [](const WorkerResult& result) { return result.preliminary; }),
            0);
}

// The share of a full identification is that of the experiments that are new since the last one.
TEST(IdentificationWorker, ANewExperimentOutOfAHundredCostsFewPasses) {
  constexpr int kMostPasses = 15;
  Configuration configuration = example1Configuration();
  configuration.full_identification.quiet = 0;
  const auto experiments = example1Experiments(112);
  Fixture fixture(configuration);
  for (int k = 0; k < 100; ++k) fixture.worker.add(experiments[static_cast<std::size_t>(k)]);
  ASSERT_TRUE(fixture.waitUntilIdle());
  const auto added_together = static_cast<long>(fixture.results().size());
  for (std::size_t k = 100; k < experiments.size(); ++k) {
    const std::size_t before = fixture.results().size();
    fixture.worker.add(experiments[k]);
    ASSERT_TRUE(waitFor([&] { return fixture.results().size() > before; }));
    const WorkerResult quick = fixture.results()[before];
    EXPECT_TRUE(quick.preliminary);
    EXPECT_EQ(quick.estimate->termination, Termination::converged);
    EXPECT_EQ(quick.estimate->experiment_count, static_cast<int>(k) + 1);
    EXPECT_LE(quick.estimate->trace.back().passes, kMostPasses) << "before the standard errors";
    ASSERT_TRUE(fixture.waitUntilIdle());
  }
  const auto results = fixture.results();
  EXPECT_TRUE(std::any_of(results.begin() + added_together, results.end(),
                          [](const WorkerResult& result) { return !result.preliminary; }))
      << "more than a tenth of the experiments are new";
}

/// Gives a worker 12 experiments of the time before, and a result whose log-likelihood is off by
/// `error`; then the last result, once it was identified in full.
WorkerResult afterRestart(double error, Fixture& fixture) {
  const auto experiments = example1Experiments(12);
  Estimate estimate = Identifier(example1Configuration()).identify(experiments);
  estimate.log_likelihood += error;
  std::vector<KeptExperiment> kept;
  for (const auto& experiment : experiments)
    kept.push_back({kept.size() + 1, std::make_shared<const Experiment>(experiment)});
  fixture.worker.restore(std::move(kept), {}, experiments.size(),
                         WorkerResult{std::make_shared<const Estimate>(estimate), true,
                                      windowOf(experiments), example1Configuration()});
  if (!waitFor([&] { return !fixture.results().empty(); }))
    throw std::runtime_error("not identified in full");
  EXPECT_TRUE(fixture.waitUntilIdle());
  EXPECT_EQ(fixture.results().size(), 1U) << "nothing is new: no quick update";
  return fixture.results().back();
}

TEST(IdentificationWorker, TheBetterOfTwoOptimaStaysAndIsTold) {
  const double right =
      Identifier(example1Configuration()).identify(example1Experiments(12)).log_likelihood;
  Fixture worse, same, better;
  const WorkerResult found = afterRestart(-5, worse);
  EXPECT_FALSE(found.preliminary);
  EXPECT_EQ(found.estimate->log_likelihood, right);
  ASSERT_FALSE(found.estimate->warnings.empty());
  EXPECT_NE(found.estimate->warnings.back().find("better optimum"), std::string::npos);
  EXPECT_EQ(worse.warnings().back(), found.estimate->warnings.back());
  EXPECT_EQ(afterRestart(0, same).estimate->warnings.size() + 1, found.estimate->warnings.size());
  EXPECT_EQ(afterRestart(5, better).estimate->log_likelihood, right + 5);
}

TEST(IdentificationWorker, StatusTellsWhatIsStored) {
  Fixture fixture;
  EXPECT_EQ(fixture.worker.status().message, "no experiment has finished yet");
  const auto experiments = example1Experiments(6);
  for (const auto& experiment : experiments) fixture.worker.add(experiment);
  ASSERT_TRUE(fixture.waitUntilIdle());
  const auto status = fixture.worker.status();
  EXPECT_EQ(status.stored, 6);
  EXPECT_EQ(status.queue, 0);
  EXPECT_EQ(status.last_id, experiments.back().id);
  EXPECT_EQ(status.termination, Termination::converged) << status.message;
  EXPECT_FALSE(status.failed);
  EXPECT_GT(status.seconds, 0);
  EXPECT_GT(fixture.changes, 6);
  EXPECT_EQ(fixture.worker.experiments().size(), 6U);
}

TEST(IdentificationWorker, BadExperimentsAreToldAndTheLastResultStays) {
  Fixture fixture;
  for (const auto& experiment : example1Experiments(6)) fixture.worker.add(experiment);
  ASSERT_TRUE(fixture.waitUntilIdle());
  const auto good = fixture.results().size();

  Recording backward;
  backward.id = "backward";
  backward.input = {{1, 2, 1.5}, {1, 2, 3}};
  backward.output = {{1, 2, 3}, {1, 2, 3}};
  fixture.worker.add(backward);
  fixture.worker.add(RejectedExperiment{"cut", "the clock went back"});
  ASSERT_TRUE(waitFor([&] { return fixture.worker.experiments().size() == 8U; }));
  ASSERT_TRUE(fixture.waitUntilIdle());
  const auto digests = fixture.worker.experiments();
  EXPECT_NE(digests[6].rejected.find("'backward'"), std::string::npos) << digests[6].rejected;
  EXPECT_EQ(digests[7].rejected, "the clock went back");
  EXPECT_EQ(fixture.warnings().size(), 2U);
  for (std::size_t i = good; i < fixture.results().size(); ++i)
    EXPECT_EQ(fixture.results()[i].estimate->experiment_count, 6);
}

TEST(IdentificationWorker, AResultComesWithItsExperimentsAndCountsThoseThatAreNotUsed) {
  Fixture fixture;
  Experiment constant = example1Experiments(1).front();
  constant.id = "constant";
  constant.u.setZero();
  fixture.worker.add(RejectedExperiment{"cut", "the clock went back"});
  fixture.worker.add(constant);
  for (const auto& experiment : example1Experiments(6)) fixture.worker.add(experiment);
  ASSERT_TRUE(fixture.waitUntilIdle());
  ASSERT_FALSE(fixture.results().empty());
  const WorkerResult last = fixture.results().back();
  EXPECT_EQ(last.estimate->experiment_count, 6);
  EXPECT_EQ(last.kept.size(), 7U);
  EXPECT_EQ(last.rejected, 2);
  EXPECT_GT(fixture.progress, 0);
}

// Who goes by what is told must not wait for a change that does not come.
TEST(IdentificationWorker, TheLastStatusToldIsThatOfAnIdleWorker) {
  Fixture fixture;
  fixture.worker.add(RejectedExperiment{"cut", "the clock went back"});
  EXPECT_TRUE(waitFor([&] { return fixture.changes > 1 && !fixture.told_busy; }));
  for (const auto& experiment : example1Experiments(5)) fixture.worker.add(experiment);
  ASSERT_TRUE(fixture.waitUntilIdle());
  EXPECT_TRUE(waitFor([&] { return !fixture.told_busy; }));
}

TEST(IdentificationWorker, DataThatCannotBeIdentifiedAreAnErrorNotAResult) {
  Fixture fixture;
  Experiment constant = example1Experiments(1).front();
  constant.u.setConstant(1);
  fixture.worker.add(constant);
  ASSERT_TRUE(waitFor([&] { return fixture.worker.status().stored == 1; }));
  ASSERT_TRUE(fixture.waitUntilIdle());
  EXPECT_TRUE(fixture.worker.status().failed);
  EXPECT_NE(fixture.worker.status().message.find("constant"), std::string::npos)
      << fixture.worker.status().message;
  EXPECT_TRUE(fixture.results().empty());
}

TEST(IdentificationWorker, ResetForgetsExperimentsAndCancels) {
  Fixture fixture;
  for (const auto& experiment : example1Experiments(30)) fixture.worker.add(experiment);
  fixture.worker.reset();
  EXPECT_EQ(fixture.worker.status().stored, 0);
  EXPECT_TRUE(fixture.worker.experiments().empty());
  const auto before = fixture.results().size();
  for (const auto& experiment : example1Experiments(5)) fixture.worker.add(experiment);
  ASSERT_TRUE(waitFor([&] { return fixture.worker.status().stored == 5; }));
  ASSERT_TRUE(fixture.waitUntilIdle());
  const auto results = fixture.results();
  ASSERT_GT(results.size(), before);
  for (std::size_t i = before; i < results.size(); ++i)
    EXPECT_LE(results[i].estimate->experiment_count, 5);
}

TEST(IdentificationWorker, EndsWhileIdentifying) {
  for (int run = 0; run < 5; ++run) {
    Fixture fixture;
    for (const auto& experiment : example1Experiments(40)) fixture.worker.add(experiment);
    if (run > 0) {
      EXPECT_TRUE(waitFor([&] { return fixture.worker.status().stored > 0; }));
    }
  }
}

TEST(IdentificationWorker, RefusesABadConfiguration) {
  Configuration configuration;
  configuration.nominal_model.delay = -1;
  EXPECT_THROW(Fixture fixture(configuration), ConfigurationError);
}

}  // namespace
}  // namespace uncertainty_identification
