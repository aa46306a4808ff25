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
