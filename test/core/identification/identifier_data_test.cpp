// What Identifier refuses and what it leaves out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "data/experiment_checks.h"
#include "support/core_setup.h"
#include "support/error_message.h"
#include "support/identify_example1.h"
#include "support/mentions.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::anyMentions;
using test::mentions;

TEST(IdentifierData, ListsRejectedExperimentsAndGoesOnWithTheOthers) {
  const std::vector<Experiment> good = test::example1Experiments(12);
  std::vector<Experiment> mixed = good;
  Experiment broken = good[0], brief = good[1];
  broken.id = "broken";
  broken.u[3] = std::nan("");
  brief.id = "brief";
  brief.u.conservativeResize(9);
  brief.y.conservativeResize(9);
  mixed.insert(mixed.begin() + 4, broken);
  mixed.push_back(brief);
  const Configuration configuration = test::example1Configuration();
  const Estimate estimate = test::identified(configuration, mixed);
  ASSERT_EQ(estimate.rejected.size(), 2u);
  EXPECT_EQ(estimate.rejected[0].id, "broken");
  EXPECT_TRUE(mentions(estimate.rejected[0].reason, "sample 3")) << estimate.rejected[0].reason;
  EXPECT_EQ(estimate.rejected[1].id, "brief");
  EXPECT_EQ(estimate.experiment_count, 12);
  EXPECT_EQ(estimate.sample_count, 1200);
  EXPECT_EQ(estimate.data_fingerprint, dataFingerprint(good));
  EXPECT_EQ(estimate.log_likelihood, test::identified(configuration, good).log_likelihood);
}

TEST(IdentifierData, RefusesWhenNoneIsLeft) {
  const Identifier identifier(test::example1Configuration());
  EXPECT_TRUE(mentions(messageOf<DataError>([&] { identifier.identify({}); }), "no experiments"));
  std::vector<Experiment> broken = test::example1Experiments(2);
  for (Experiment& experiment : broken) experiment.u[0] = INFINITY;
  const std::string message = messageOf<DataError>([&] { identifier.identify(broken); });
  EXPECT_TRUE(mentions(message, "no usable experiment")) << message;
  EXPECT_TRUE(mentions(message, broken[1].id)) << message;
}

TEST(IdentifierData, OfOneExperimentGivesAPlainNominalModel) {
  Configuration configuration = test::example1Configuration();
  const Estimate estimate = test::identified(configuration, test::example1Experiments(1));
  EXPECT_TRUE(estimate.usable()) << estimate.message;
  EXPECT_EQ(estimate.error_model.options.taps, 0);
  EXPECT_EQ(estimate.error_model.mixture.dimension(), 0);
  EXPECT_TRUE(estimate.error_model.parameters.empty());
  EXPECT_TRUE(anyMentions(estimate.warnings, "one experiment"));
  EXPECT_GT(estimate.nominal_model.parameters[0].standard_error, 0);
}

TEST(IdentifierData, OfTwoOrThreeExperimentsGivesOneComponent) {
  for (int experiments : {2, 3}) {
    const Estimate estimate =
        test::identified(test::example1Configuration(), test::example1Experiments(experiments));
    EXPECT_TRUE(estimate.usable()) << estimate.message;
    EXPECT_EQ(estimate.error_model.mixture.components(), 1);
    EXPECT_TRUE(anyMentions(estimate.warnings, std::to_string(experiments) + " experiments"));
  }
}

TEST(IdentifierData, RefusesOrdersTooLargeForIt) {
  Configuration configuration = test::example1Configuration();
  configuration.nominal_model.nb = configuration.nominal_model.na = 15;
  configuration.estimation.initial_state = InitialState::estimate;
  std::vector<Experiment> brief = test::example1Experiments(3);
  for (Experiment& experiment : brief) {
    experiment.u.conservativeResize(25);
    experiment.y.conservativeResize(25);
  }
  const std::string message = messageOf<DataError>([&] { test::identified(configuration, brief); });
  EXPECT_TRUE(mentions(message, "orders are too large")) << message;
  EXPECT_TRUE(mentions(message, "75 measured samples")) << message;
}

TEST(IdentifierConfiguration, IsValidated) {
  Configuration configuration;
  configuration.nominal_model.nb = 0;
  EXPECT_THROW(Identifier{configuration}, ConfigurationError);
  configuration = Configuration();
  configuration.estimation.tolerance = -1;
  EXPECT_THROW(Identifier{configuration}, ConfigurationError);
}

TEST(IdentifierConfiguration, RefusesAStartThatDoesNotFit) {
  const std::vector<Experiment> experiments = test::example1Experiments(6);
  Configuration configuration = test::example1Configuration();
  configuration.initial.theta = test::vectorOf({1, 0.5, 0.1});
  std::string message =
      messageOf<ConfigurationError>([&] { test::identified(configuration, experiments); });
  EXPECT_TRUE(mentions(message, "initial.theta")) << message;
  EXPECT_TRUE(mentions(message, "b1, a1, c1, d1")) << message;
  EXPECT_TRUE(mentions(message, "found 3")) << message;
  configuration.initial.theta = test::vectorOf({1, 1.5, 0.1, 0.8});
  message = messageOf<ConfigurationError>([&] { test::identified(configuration, experiments); });
  EXPECT_TRUE(mentions(message, "unit circle")) << message;
  configuration.initial.theta = test::vectorOf({1, 0.5, 0.1, 0.8});
  configuration.initial.mixture = {{1.0}, {VectorXd::Zero(2)}, {MatrixXd::Identity(2, 2)}};
  message = messageOf<ConfigurationError>([&] { test::identified(configuration, experiments); });
  EXPECT_TRUE(mentions(message, "initial.means")) << message;
}

TEST(IdentifierData, IgnoresTheOrderOfTheExperiments) {
  std::vector<Experiment> experiments = test::example1Experiments(24);
  const Estimate one = test::identified(test::example1Configuration(), experiments);
  std::reverse(experiments.begin(), experiments.end());
  const Estimate other = test::identified(test::example1Configuration(), experiments);
  EXPECT_NEAR(other.log_likelihood, one.log_likelihood, 1e-5);
  EXPECT_EQ(other.data_fingerprint, one.data_fingerprint);
}

}  // namespace
}  // namespace uncertainty_identification
