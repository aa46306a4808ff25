#include "effects/extended_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "support/core_setup.h"
#include "support/effect_setup.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Statistics of all experiments in one vector, and their derivatives in columns.
VectorXd values(const Statistics& s) {
  VectorXd all(s.experiments() * (s.gram(0).size() + 2));
  Index at = 0;
  for (int r = 0; r < s.experiments(); ++r) {
    const MatrixXd gram = s.gram(r);
    all.segment(at, gram.size()) = Eigen::Map<const VectorXd>(gram.data(), gram.size());
    at += gram.size();
    all[at++] = s.logJacobian()[r];
    all[at++] = s.samples()[r];
  }
  return all;
}

VectorXd derivative(const Statistics& s, int j) {
  VectorXd all(s.experiments() * (s.gram(0).size() + 1));
  Index at = 0;
  for (int r = 0; r < s.experiments(); ++r) {
    const MatrixXd gram = s.gramDerivative(r, j);
    all.segment(at, gram.size()) = Eigen::Map<const VectorXd>(gram.data(), gram.size());
    at += gram.size();
    all[at++] = s.logJacobianDerivatives()(j, r);
  }
  return all;
}

Statistics statistics(const test::EffectSetup& setup, const LinearModel& model,
                      const VectorXd& parameters, bool derivatives) {
  return Likelihood(model, setup.blocks(), static_cast<int>(setup.experiments().size()), 1)
      .statistics(parameters, derivatives);
}

using Nuisances = std::tuple<bool, InitialState, Offsets, OffsetSide>;

class ExtendedByNothing : public testing::TestWithParam<Nuisances> {};

TEST_P(ExtendedByNothing, IsTheLinearModel) {
  const auto [gaps, initial_state, offsets, side] = GetParam();
  Configuration configuration = test::effectConfiguration();
  configuration.estimation.initial_state = initial_state;
  configuration.estimation.discard_samples = 4;
  configuration.estimation.offsets = offsets;
  configuration.estimation.offset_side = side;
  std::vector<Experiment> experiments = test::recordedForEffects();
  for (std::size_t r = 0; gaps && r < experiments.size(); r += 2) {
    experiments[r].valid.assign(static_cast<std::size_t>(experiments[r].samples()), 1);
    for (std::size_t k : {7, 8, 20}) experiments[r].valid[k + r] = 0;
  }
  const test::EffectSetup setup(configuration, experiments);
  const auto extended = setup.extended({});
  const VectorXd at = setup.at().parameters;
  EXPECT_EQ(extended->names(), setup.linear().names());
  const Statistics linear = statistics(setup, setup.linear(), at, true);
  const Statistics found = statistics(setup, *extended, at, true);
  EXPECT_LT((values(found) - values(linear)).norm(), 1e-10 * values(linear).norm());
  for (int j = 0; j < at.size(); ++j) {
    EXPECT_LT((derivative(found, j) - derivative(linear, j)).norm(),
              1e-5 * (1 + derivative(linear, j).norm()))
        << extended->names()[static_cast<std::size_t>(j)];
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExtendedByNothing,
                         testing::Combine(testing::Bool(),
                                          testing::Values(InitialState::zero, InitialState::discard,
                                                          InitialState::estimate),
                                          testing::Values(Offsets::none, Offsets::estimate,
                                                          Offsets::per_experiment),
                                          testing::Values(OffsetSide::output, OffsetSide::input)));

TEST(ExtendedModel, OfNeutralEffectsIsTheLinearModel) {
  const test::EffectSetup setup;
  const VectorXd plain = setup.logLikelihoods(setup.linear(), setup.at());
  for (const auto& effect : setup.all()) {
    if (effect->stage() == Stage::data) continue;
    const VectorXd psi = test::neutral(*effect);
    ASSERT_EQ(psi.size(), effect->parameterCount()) << effect->label();
    ASSERT_TRUE(effect->admissible(psi)) << effect->label();
    const VectorXd found = setup.logLikelihoods(*setup.extendedBy({effect}), setup.at(psi));
    const bool random = effect->description().parameters.front().log_variance;
    // a random signal of variance e^-14 sigma^2 in 50 samples; a quantiser's step of 1e-6
    const double tolerance = random ? 3e-3 : effect->name() == "act_quantisation" ? 1e-3 : 1e-8;
    EXPECT_LT((found - plain).cwiseAbs().maxCoeff(), tolerance) << effect->label();
  }
}

/// So that the test above says something.
TEST(ExtendedModel, OfNoticeableEffectsIsNot) {
  const test::EffectSetup setup;
  const VectorXd plain = setup.logLikelihoods(setup.linear(), setup.at());
  for (const auto& effect : setup.all()) {
    if (effect->stage() == Stage::data) continue;
    const VectorXd psi = test::noticeable(*effect);
    const VectorXd found = setup.logLikelihoods(*setup.extendedBy({effect}), setup.at(psi));
    EXPECT_TRUE(found.allFinite()) << effect->label();
    EXPECT_GT((found - plain).cwiseAbs().maxCoeff(), 0.1) << effect->label();
  }
}

TEST(ExtendedModel, NamesItsParametersByEffect) {
  const test::EffectSetup setup;
  const auto model = setup.extended({{"act_loss", ""}, {"sens_bias", "per_experiment"}});
  std::vector<std::string> names = setup.linear().names();
  names.insert(names.end(), {"act_loss.share", "act_loss.time", "sens_bias.deviation"});
  EXPECT_EQ(model->names(), names);
  EXPECT_EQ(model->effectParameterCount(), 3);
  const VectorXd at = setup.at(test::vectorOf({0.1, 8, -1})).parameters;
  EXPECT_EQ(model->psi(at, 0), test::vectorOf({0.1, 8}));
  EXPECT_EQ(model->psi(at, 1), test::vectorOf({-1}));
  EXPECT_TRUE(model->fromUnbounded(model->toUnbounded(at)).isApprox(at, 1e-12));
  EXPECT_TRUE(model->admissible(at));
  VectorXd outside = at;
  outside[model->offsetOf(0)] = 1.5;  // more than all of the actuator
  EXPECT_FALSE(model->admissible(outside));
}

/// The order of naming does not matter, the physical one does.
TEST(ExtendedModel, EffectsActInPhysicalOrder) {
  const test::EffectSetup setup;
  const auto one = setup.extended({{"act_saturation", ""}, {"act_offset", ""}});
  const auto other = setup.extended({{"act_offset", ""}, {"act_saturation", ""}});
  const auto first = setup.simulated(*one, setup.at(test::vectorOf({1, 3})).parameters);
  const auto second = setup.simulated(*other, setup.at(test::vectorOf({3, 1})).parameters);
  for (std::size_t r = 0; r < first.size(); ++r) {
    EXPECT_EQ(first[r], second[r]);
    // the offset comes before the saturation: nothing beyond 1 reaches 0.9/(1 - 0.6 q^-1)
    EXPECT_LT(first[r].maxCoeff(), 0.9 / 0.4 + 1e-9);
  }
}

TEST(ExtendedModel, IsExactAtThePointsItIsLinearisedAbout) {
  Configuration configuration = test::effectConfiguration();
  configuration.estimation.noise_start = NoiseStart::zero;
  const test::EffectSetup setup(configuration);
  const auto count = static_cast<Index>(setup.experiments().size());
  const MatrixXd xi = 0.2 * MatrixXd::Random(setup.linear().regressors(), count);
  for (const char* name : {"plant_cubic", "plant_coulomb", "sens_wiener", "sens_clip"}) {
    const auto model = setup.extended({{name, ""}});
    ASSERT_TRUE(model->isLocallyLinear()) << name;
    const VectorXd at = setup.at(test::noticeable(*model->effects().front())).parameters;
    const auto about = model->about(model->points(at, xi));
    const auto exact = setup.simulated(*model, at, xi);
    for (const Block& block : setup.blocks()) {
      Response linear;
      about->evaluate(block, at, false, &linear);
      // H^-1 (y - x) at xi, from the linearisation and from the simulation
      for (int lane = 0; lane < block.lanes; ++lane) {
        const int r = block.index[static_cast<std::size_t>(lane)];
        const int length = block.lengths[static_cast<std::size_t>(lane)];
        VectorXd expected =
            setup.experiments()[static_cast<std::size_t>(r)].y - exact[static_cast<std::size_t>(r)];
        const VectorXd v = expected;
        for (int t = 0; t < length; ++t)
          expected[t] = v[t] + (t > 0 ? -0.4 * v[t - 1] - 0.3 * expected[t - 1] : 0.0);
        Eigen::ArrayXd found = linear.value.residual.row(lane).head(length).transpose();
        for (Index i = 0; i < xi.rows(); ++i)
          found -= xi(i, r) * linear.value.regressors[static_cast<std::size_t>(i)]
                                  .row(lane)
                                  .head(length)
                                  .transpose();
        EXPECT_LT((found.matrix() - expected).cwiseAbs().maxCoeff(), 1e-9) << name;
      }
    }
  }
}

TEST(MakeExtendedModel, RefusesWhatDoesNotFit) {
  const std::vector<Experiment> experiments = test::recordedForEffects();
  const auto messageFor = [&](const std::string& name, const std::string& variant) {
    Configuration configuration = test::effectConfiguration();
    configuration.effects = {{name, variant, {}}};
    return messageOf<ConfigurationError>([&] {
      makeExtendedModel(makeNominalModel(configuration.nominal_model, 0.5), configuration,
                        experiments);
    });
  };
  EXPECT_EQ(messageFor("act_deadzone", ""), "no exception");
  EXPECT_NE(messageFor("act_deedzone", "").find("act_deadzone"), std::string::npos);
  EXPECT_NE(messageFor("sens_outliers", "").find("found in the data themselves"),
            std::string::npos);
  const auto effect = findEffect(test::EffectSetup().all(), "act_deadzone", "");
  const std::string message = messageOf<ConfigurationError>([&] {
    startingValues({effect}, {{"act_deadzone", "", {{"with", 1.0}}}});
  });
  EXPECT_NE(message.find("it has width"), std::string::npos) << message;
  EXPECT_EQ(startingValues({effect}, {{"act_deadzone", "", {{"width", 0.7}}}}),
            test::vectorOf({0.7}));
}

}  // namespace
}  // namespace uncertainty_identification
