// Causes of records of which none is held out, confirmed on the last thirds of these.
#include "explanation/last_thirds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "explanation/search_outcome.h"
#include "explanation/simulation_answer.h"
#include "support/mentions.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

/// A first-order plant whose input is limited to 0.8.
Experiment limited(int samples) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> between(-1.2, 1.2);
  Experiment experiment;
  experiment.id = "1";
  experiment.sample_time = 0.1;
  experiment.u.resize(samples);
  experiment.y.resize(samples);
  double x = 0;
  for (int k = 0; k < samples; ++k) {
    experiment.u[k] = k % 15 == 0 ? between(random) : experiment.u[k - 1];
    experiment.y[k] = x + 0.02 * normal(random);
    x += 0.1 * (std::clamp(experiment.u[k], -0.8, 0.8) - x);
  }
  return experiment;
}

SearchOutcome foundIn(const Split& data, const FitContext& context, const Estimate& estimate) {
  return searchOnTopOf(estimate.configuration.explanation, context, estimate, data, {},
                       {"act_saturation"});
}

TEST(LastThirds, ATrueCauseGainsThere) {
  Configuration configuration;
  configuration.nominal_model.structure = Structure::output_error;
  configuration.nominal_model.orders_auto = false;
  configuration.error_model.taps = 0;
  configuration.bounds.frequencies = 0;
  const std::vector<Experiment> records{limited(600)};
  const Estimate estimate = Identifier(configuration).identify(records, {}, {});
  WorkerPool pool(1);
  FitContext context = contextOf(estimate, 1);
  context.pool = &pool;
  const SearchOutcome in_sample = foundIn({records, records, true}, context, estimate);
  ASSERT_EQ(in_sample.found.causes.size(), 1u);
  const auto gains = gainOnLastThirds(in_sample.base, in_sample.found, context);
  ASSERT_TRUE(gains);
  EXPECT_GT(gains->log_density, 20);
  EXPECT_GT(gains->first, 20);
  EXPECT_LT(gains->error_ratio, 0.5);
  SearchState as_before = in_sample.found;
  as_before.fit = in_sample.base.fit;
  const auto nothing = gainOnLastThirds(in_sample.base, as_before, context);
  ASSERT_TRUE(nothing);
  EXPECT_NEAR(nothing->log_density, 0, 1e-6);
  EXPECT_NEAR(nothing->error_ratio, 1, 1e-6);
  SearchState held_out = in_sample.found;
  held_out.fitted_to = false;
  EXPECT_FALSE(gainOnLastThirds(in_sample.base, held_out, context));
}

/// All tests pass with the causes; the free simulation shows none.
Explanation explainedBy(const std::vector<std::string>& names) {
  Explanation explanation;
  explanation.verdict = Verdict::explained;
  for (const std::string& name : names) {
    Cause cause;
    cause.name = name;
    cause.group = "actuator";
    cause.gain = Gain{};
    cause.gain->nrmse_fit_percent = {90, 92};
    cause.gain->coverage_95 = {0.95, 0.95};
    explanation.causes.push_back(cause);
  }
  return explanation;
}

TEST(LastThirds, ConfirmOneCauseThatExplainsAll) {
  const auto answered = [](const std::vector<std::string>& names, const LastThirds& gains) {
    Explanation found = explainedBy(names);
    joinSimulation(&found, gains);
    return found;
  };
  const Explanation confirmed = answered({"act_saturation"}, {20, 30, 0.36});
  EXPECT_EQ(confirmed.verdict, Verdict::explained);
  ASSERT_EQ(confirmed.causes.size(), 1u);
  EXPECT_TRUE(test::anyMentions(confirmed.warnings, "more likely by 20 nats"));
  EXPECT_TRUE(test::anyMentions(confirmed.warnings, "60 % of that without"));
  EXPECT_TRUE(answered({"act_saturation"}, {5, 30, 0.36}).causes.empty());
  EXPECT_TRUE(answered({"act_saturation"}, {20, 30, 0.9}).causes.empty());
  EXPECT_TRUE(answered({"act_saturation"}, {20, 0, 0.36}).causes.empty())
      << "only the last third shows it, which it is fitted to";
  EXPECT_TRUE(answered({"act_saturation", "act_lag"}, {20, 30, 0.36}).causes.empty());
}

}  // namespace
}  // namespace uncertainty_identification
