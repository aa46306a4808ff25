// A bag of stamped samples, replayed through the node, gives what identifying the bag offline
// gives.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/example1.h"
#include "support/node_client.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/io/result_json.h"
#include "uncertainty_identification/ros/bag_reader.h"
#include "uncertainty_identification/ros/bag_writer.h"
#include "uncertainty_identification/ros/parameters.h"

namespace uncertainty_identification {
namespace {

constexpr int kExperiments = 20;

void expectNear(double actual, double expected, const std::string& what) {
  EXPECT_NEAR(actual, expected, 1e-9 * std::max(1.0, std::abs(expected))) << what;
}

void expectNear(const std::vector<double>& actual, const Eigen::VectorXd& expected,
                const std::string& what) {
  ASSERT_EQ(static_cast<Eigen::Index>(actual.size()), expected.size()) << what;
  for (std::size_t i = 0; i < actual.size(); ++i)
    expectNear(actual[i], expected[static_cast<Eigen::Index>(i)], what);
}

TEST(Replay, GivesTheSameExperimentsAndNumbersAsReadingTheBag) {
  const TemporaryFolder folder;
  const std::string bag = folder / "example1.bag";
  writeBag(bag, example1Experiments(kExperiments));
  NodeClient client;
  ASSERT_TRUE(client.waitForNode());
  ASSERT_EQ(playBag(bag, "--rate=10"), 0);
  ASSERT_TRUE(client.waitUntilStored(kExperiments)) << client.status().message;

  const Configuration configuration = loadParameters(client.node());
  const auto offline = readBag(bag, configuration).experiments;
  const auto list = client.call<messages::ListExperiments>("list_experiments").experiments;
  ASSERT_EQ(list.size(), offline.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_EQ(list[i].id, offline[i].id);
    EXPECT_EQ(list[i].samples, static_cast<unsigned>(offline[i].validSamples()));
    EXPECT_EQ(list[i].start.toSec(), offline[i].start_time);
  }

  const Estimate expected = Identifier(configuration).identify(offline);
  ASSERT_EQ(expected.termination, Termination::converged);
  const auto answer = client.call<messages::GetResult>("get_result");
  ASSERT_EQ(answer.code, messages::GetResult::Response::OK) << answer.message;
  const auto& result = answer.result;
  EXPECT_FALSE(result.preliminary);
  EXPECT_EQ(result.termination, messages::IdentificationResult::CONVERGED);
  EXPECT_EQ(result.experiment_count, static_cast<unsigned>(kExperiments));
  EXPECT_EQ(result.fingerprint, expected.data_fingerprint);
  expectNear(result.log_likelihood, expected.log_likelihood, "log-likelihood");
  expectNear(result.nominal_model.b, expected.nominal_model.b, "b");
  expectNear(result.nominal_model.a, expected.nominal_model.a, "a");
  expectNear(result.nominal_model.c, expected.nominal_model.c, "c");
  expectNear(result.nominal_model.d, expected.nominal_model.d, "d");
  expectNear(result.nominal_model.noise_variance, expected.noise_variance.value, "noise variance");
  const Mixture& mixture = expected.error_model.mixture;
  ASSERT_EQ(result.error_model.components.size(), mixture.weights.size());
  for (std::size_t i = 0; i < mixture.weights.size(); ++i) {
    expectNear(result.error_model.components[i].weight, mixture.weights[i], "weight");
    expectNear(result.error_model.components[i].mean, mixture.means[i], "mean");
    expectNear(result.error_model.components[i].covariance[0], mixture.covariances[i](0, 0),
               "covariance");
  }
  EXPECT_EQ(estimateFromJson(nlohmann::json::parse(result.result_json)).log_likelihood,
            result.log_likelihood);
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "replay_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
