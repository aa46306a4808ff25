#include "session/reconfiguration.h"

#include <gtest/gtest.h>

#include "session/refused_error.h"
#include "session/request_limits.h"
#include "support/error_message.h"
#include "support/example1.h"
#include "support/wait_for.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

class ReconfigurationTest : public testing::Test {
 protected:
  Reconfiguration::Outcome configure(const std::string& yaml, bool keep_going = true) {
    return reconfiguration_.configure(yaml, [keep_going] { return keep_going; });
  }

  Configuration parameters_ = example1Configuration();
  std::vector<StoredConfiguration> kept_;
  IdentificationWorker worker_{
      parameters_,
      {[](const WorkerResult&) {}, [](const KeptExperiment&) {}, [](const RejectedExperiment&) {},
       [] {}, [](const std::string&) {}}};
  Reconfiguration reconfiguration_{
      parameters_, parameters_, worker_,
      [this](const StoredConfiguration& configuration) { kept_.push_back(configuration); }};
};

TEST_F(ReconfigurationTest, AdoptsAConfigurationThatGivesAUsableModel) {
  for (const auto& experiment : example1Experiments(8)) worker_.add(experiment);
  ASSERT_TRUE(waitFor([&] { return worker_.status().stored == 8; }));
  const std::string one =
      "{nominal_model: {nb: 1, na: 1, nc: 1, nd: 1, delay: 1}, error_model: {components: 1}}";
  EXPECT_FALSE(configure(one, false).adopted) << "cancelled";
  EXPECT_EQ(reconfiguration_.current().error_model.components, 2);
  EXPECT_TRUE(kept_.empty());
  EXPECT_TRUE(configure(one).adopted);
  EXPECT_EQ(reconfiguration_.current().error_model.components, 1);
  ASSERT_EQ(kept_.size(), 1U);
  EXPECT_EQ(kept_[0].configuration.error_model.components, 1);
  EXPECT_EQ(kept_[0].parameters.error_model.components, 2);
}

TEST_F(ReconfigurationTest, LimitsThatAreLeftOutStay) {
  configure("{nominal_model: {orders: auto}, limits: {max_experiments: 10}}");
  configure("{nominal_model: {orders: auto}, limits: {max_missing: 0.1}}");
  EXPECT_EQ(reconfiguration_.current().limits.max_experiments, 10);
  EXPECT_EQ(reconfiguration_.current().limits.max_missing, 0.1);
}

TEST_F(ReconfigurationTest, RefusesToRaiseLimitsAndToChangeTopics) {
  const auto refusal = [&](const std::string& yaml) {
    return messageOf<RefusedError>([&] { configure("{nominal_model: {orders: auto}, " + yaml); });
  };
  EXPECT_NE(refusal("limits: {max_samples: 2000000}}").find("limits.max_samples"),
            std::string::npos);
  EXPECT_NE(refusal("input: {topic: other}}").find("input"), std::string::npos);
  EXPECT_NE(refusal("store_directory: /tmp}").find("store_directory"), std::string::npos);
  EXPECT_NE(refusal("live_page: {port: 8080}}").find("live_page"), std::string::npos);
  EXPECT_THROW(configure("no configuration"), ConfigurationError);
  EXPECT_TRUE(kept_.empty());
}

TEST(ConfigurationAtStart, IsTheStoredOneUnlessTheParametersHaveChanged) {
  Configuration before, other;
  before.nominal_model.nb = 2;
  other.nominal_model.nb = 3;
  const StoredConfiguration stored{other, before};
  EXPECT_EQ(configurationAtStart(before, stored).nominal_model.nb, 3);
  EXPECT_EQ(configurationAtStart(Configuration(), stored).nominal_model.nb,
            Configuration().nominal_model.nb);
  EXPECT_EQ(configurationAtStart(before, std::nullopt).nominal_model.nb, 2);
}

TEST(RequestLimits, ARequestCannotRaiseTheNodesLimits) {
  Configuration own;
  own.limits.max_experiments = 5;
  own.estimation.threads = 2;
  EXPECT_EQ(requestedConfiguration("", own).limits.max_experiments, 5);
  const Configuration asked = requestedConfiguration(
      "{nominal_model: {orders: auto}, limits: {max_experiments: 9, max_samples: 700}, "
      "estimation: {threads: 64}}",
      own);
  EXPECT_EQ(asked.limits.max_experiments, 5);
  EXPECT_EQ(asked.limits.max_samples, 700);
  EXPECT_EQ(asked.estimation.threads, 2);
}

TEST(RequestLimits, EveryRequestHasATimeLimit) {
  Configuration own;
  own.limits.max_request_time = 30;
  own.explanation.time_limit = 20;
  EXPECT_EQ(requestedConfiguration("", own).estimation.time_limit, 30);
  EXPECT_EQ(requestedConfiguration("", own).explanation.time_limit, 20);
  const Configuration asked = requestedConfiguration(
      "{estimation: {time_limit: 1000}, explanation: {time_limit: 0}, "
      "limits: {max_request_time: 1000}}",
      own);
  EXPECT_EQ(asked.limits.max_request_time, 30);
  EXPECT_EQ(asked.estimation.time_limit, 30);
  EXPECT_EQ(asked.explanation.time_limit, 30);
  EXPECT_EQ(requestedConfiguration("{estimation: {time_limit: 4}}", own).estimation.time_limit, 4);
}

/// 8 experiments of 100 samples allow 80 parameters.
TEST(RequestLimits, WhatTheDataCannotDetermineIsRefusedWithTheNumbers) {
  Configuration configuration;
  configuration.nominal_model.orders_auto = false;
  NominalModelOptions& nominal = configuration.nominal_model;
  nominal.nb = nominal.na = nominal.nc = nominal.nd = 20;
  const auto experiments = example1Experiments(8);
  requireEnoughSamples(configuration, experiments);
  nominal.na = 21;
  const std::string message =
      messageOf<DataError>([&] { requireEnoughSamples(configuration, experiments); });
  for (const char* part : {"81 parameters (nb 20, na 21, nc 20, nd 20)", "8 experiments",
                           "800 measured samples", "here 810"})
    EXPECT_NE(message.find(part), std::string::npos) << message;
  nominal.orders_auto = true;
  requireEnoughSamples(configuration, experiments);
  nominal.orders_auto = false;
  requireEnoughSamples(configuration, {});
}

TEST_F(ReconfigurationTest, DoesNotAdoptWhatTakesTooLong) {
  for (const auto& experiment : example1Experiments(21)) worker_.add(experiment);
  ASSERT_TRUE(waitFor([&] { return worker_.status().stored == 21; }));
  const auto outcome = configure(
      "{nominal_model: {nb: 50, na: 50, nc: 50, nd: 50}, limits: {max_request_time: 0.3}}");
  EXPECT_FALSE(outcome.adopted);
  EXPECT_NE(outcome.message.find("time limit of 0.3 s"), std::string::npos) << outcome.message;
  EXPECT_EQ(reconfiguration_.current().nominal_model.nb, parameters_.nominal_model.nb);
}

TEST_F(ReconfigurationTest, RefusesMoreParametersThanTheExperimentsDetermine) {
  for (const auto& experiment : example1Experiments(2)) worker_.add(experiment);
  ASSERT_TRUE(waitFor([&] { return worker_.status().stored == 2; }));
  EXPECT_NE(messageOf<DataError>([&] {
              configure("{nominal_model: {nb: 50, na: 50, nc: 50, nd: 50}}");
            }).find("200 parameters"),
            std::string::npos);
}

TEST(RequestLimits, NoRequestStartsASimulationOfTheUser) {
  for (const char* yaml :
       {"simulation: {command: [touch, started]}", "simulation: {column: y_sim}"})
    EXPECT_EQ(
        messageOf<ConfigurationError>([&] { requestedConfiguration(yaml, {}); }),
        "simulation: no request starts a simulation; leave it out, and run the program explain "
        "with it");
}

TEST_F(ReconfigurationTest, RefusesASimulationOfTheUser) {
  EXPECT_NE(messageOf<ConfigurationError>([this] {
              configure("simulation: {command: [touch, started]}");
            }).find("no request starts a simulation"),
            std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
