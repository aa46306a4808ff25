#include "uncertainty_identification/effects/catalogue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/effect_setup.h"
#include "support/error_message.h"
#include "support/hidden_effects/hidden_effect.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

const Effects& all() {
  static const test::EffectSetup kSetup;
  return kSetup.all();
}

/// The names that the tool speaks in; what is hidden in tests uses the same.
TEST(Catalogue, HoldsEveryNameAndNoOther) {
  std::set<std::string> names, labels;
  for (const auto& effect : all()) {
    names.insert(effect->name());
    EXPECT_TRUE(labels.insert(effect->label()).second) << effect->label() << " is there twice";
  }
  const std::vector<std::string>& expected = test::catalogueEffects();
  EXPECT_EQ(expected.size(), 36u);
  EXPECT_EQ(names, std::set<std::string>(expected.begin(), expected.end()));
}

TEST(Catalogue, EveryEffectSaysWhatItIsAndWhatToDo) {
  std::set<std::string> names;
  for (const auto& effect : all()) names.insert(effect->name());
  for (const auto& effect : all()) {
    const EffectDescription& of = effect->description();
    SCOPED_TRACE(effect->label());
    const std::string group = of.name.substr(0, of.name.find('_'));
    EXPECT_TRUE(std::set<std::string>({"act", "plant", "sens", "noise", "exp"}).count(group));
    EXPECT_GT(of.meaning.size(), 10u);
    ASSERT_GT(of.advice.size(), 20u);
    EXPECT_EQ(of.advice.back(), '.');
    for (const std::string& other : of.equivalent) {
      EXPECT_TRUE(names.count(other)) << other;
      EXPECT_NE(other, of.name);
    }
    for (const EffectParameter& parameter : of.parameters) {
      EXPECT_FALSE(parameter.name.empty());
      EXPECT_FALSE(parameter.unit.empty());
      EXPECT_GT(parameter.scale, 0);
      EXPECT_LT(parameter.lower, parameter.upper);
    }
  }
}

/// Who is named as equivalent names the other in turn.
TEST(Catalogue, EquivalenceIsMutual) {
  std::set<std::pair<std::string, std::string>> pairs;
  for (const auto& effect : all()) {
    for (const std::string& other : effect->description().equivalent)
      pairs.insert({effect->name(), other});
  }
  for (const auto& [name, other] : pairs) EXPECT_TRUE(pairs.count({other, name})) << name;
}

TEST(Catalogue, EffectsOfTheChainHaveAdmissibleStartsOfTheirSize) {
  for (const auto& effect : all()) {
    SCOPED_TRACE(effect->label());
    const auto& starts = effect->description().starts;
    if (effect->stage() == Stage::data) {
      EXPECT_TRUE(starts.empty());
      EXPECT_EQ(effect->parameterCount(), 0);
      continue;
    }
    EXPECT_EQ(starts.empty(), effect->label() == "act_quantisation (shifted)")
        << "which starts from what residuals show";
    for (const Eigen::VectorXd& start : starts) {
      EXPECT_EQ(start.size(), effect->parameterCount());
      EXPECT_TRUE(effect->admissible(start)) << start.transpose();
    }
  }
}

/// Data with a constant and a recorded covariate, time stamps, and a plant with b1 and a1. The
/// order of the list is part of what the effects mean: a saturation behind a dead zone is another
/// actuator than one in front of it.
TEST(Catalogue, KeepsItsPhysicalOrder) {
  const std::vector<std::string> expected{
      "sens_lag", "noise_colour",
      // what drives the plant
      "act_offset", "act_delay", "act_quantisation", "act_quantisation (shifted)", "act_deadzone",
      "act_backlash", "act_ratelimit", "act_saturation", "act_hammerstein", "act_loss",
      "plant_drift", "plant_temp (flow)", "plant_temp (temp)",
      // in the loop, beside and behind the plant
      "plant_cubic", "plant_coulomb", "plant_resonance", "plant_pole",
      // the output
      "plant_aging", "plant_init", "plant_parameter_spread (b1)", "plant_parameter_spread (a1)",
      "plant_parameter_spread (time_constant)", "exp_input2 (flow)", "exp_input2 (temp)",
      "exp_jitter", "exp_clock", "sens_wiener", "sens_clip", "sens_bias",
      "sens_bias (per_experiment)", "sens_drift", "sens_drift (per_experiment)", "sens_hum",
      "sens_hum (per_experiment)",
      // the noise
      "noise_hetero (u)", "noise_hetero (x)", "noise_step",
      // outside the chain
      "sens_quant", "sens_dropout", "sens_outliers", "noise_tails", "exp_mode", "exp_feedback"};
  std::vector<std::string> found;
  for (const auto& effect : all()) found.push_back(effect->label());
  EXPECT_EQ(found, expected);
}

/// Steps that the residuals show have a level of their own only where zero is none.
TEST(Catalogue, StepsOfTheActuatorStartFromWhatTheResidualsShow) {
  const auto startsWith = [](double level, const char* variant) {
    DataSummary data;
    data.input_step = 0.5;
    data.input_level = level;
    return findEffect(catalogue(data), "act_quantisation", variant)->description().starts;
  };
  ASSERT_EQ(startsWith(20.2, "shifted").size(), 1u);
  EXPECT_EQ(startsWith(20.2, "shifted")[0], Eigen::VectorXd(Eigen::Vector2d(0.5, 20.2)));
  EXPECT_TRUE(startsWith(20.01, "shifted").empty());
  EXPECT_EQ(startsWith(20.01, "").size(), startsWith(20.2, "").size() + 1);
}

TEST(Catalogue, PositionsRiseWithinAStage) {
  for (std::size_t k = 1; k < all().size(); ++k) {
    EXPECT_LE(all()[k - 1]->stage(), all()[k]->stage());
    if (all()[k - 1]->stage() == all()[k]->stage()) {
      EXPECT_LE(all()[k - 1]->position(), all()[k]->position()) << all()[k]->label();
    }
  }
}

TEST(Catalogue, OffersOnlyWhatFitsTheData) {
  DataSummary plain;
  plain.samples = 100;
  std::set<std::string> names;
  for (const auto& effect : catalogue(plain)) names.insert(effect->name());
  for (const char* name :
       {"plant_temp", "exp_input2", "exp_jitter", "plant_aging", "plant_parameter_spread"})
    EXPECT_FALSE(names.count(name)) << name;
  EXPECT_TRUE(names.count("act_deadzone"));
}

TEST(Catalogue, ParametersOutsideTheirRangeAreNotAdmissible) {
  const auto lag = findEffect(all(), "sens_lag", "");
  EXPECT_TRUE(lag->admissible(Eigen::VectorXd::Constant(1, 0.5)));
  EXPECT_FALSE(lag->admissible(Eigen::VectorXd::Constant(1, 0.95)));
  EXPECT_FALSE(lag->admissible(Eigen::VectorXd::Constant(1, std::nan(""))));
  const auto colour = findEffect(all(), "noise_colour", "");
  EXPECT_FALSE(colour->admissible(Eigen::Vector2d(-2.1, 1.2))) << "unstable";
}

TEST(Catalogue, NamesTheNearestToAnUnknownEffect) {
  const auto messageFor = [](const std::string& name, const std::string& variant) {
    return messageOf<ConfigurationError>([&] { findEffect(all(), name, variant); });
  };
  EXPECT_NE(messageFor("act_dedzone", "").find("nearest is act_deadzone"), std::string::npos);
  EXPECT_NE(messageFor("sens_bias", "each").find("'each'"), std::string::npos);
  EXPECT_EQ(findEffect(all(), "sens_bias", "per_experiment")->label(),
            "sens_bias (per_experiment)");
}

TEST(DataSummary, HoldsWhatEffectsChooseTheirScalesBy) {
  Experiment experiment;
  experiment.sample_time = 0.1;
  experiment.u = (Eigen::VectorXd(4) << 1, 1, -3, 1).finished();
  experiment.y = (Eigen::VectorXd(4) << 2, 1e9, -2, 2).finished();
  experiment.valid = {1, 0, 1, 1};
  experiment.scalars = {{"load", 4}, {"same", 7}};
  Experiment other = experiment;
  other.scalars["load"] = 6;
  other.scalars["once"] = 1;
  const DataSummary summary = summarise({experiment, other});
  EXPECT_DOUBLE_EQ(summary.input_deviation, std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(summary.output_deviation, std::sqrt(4 - 4.0 / 9));
  EXPECT_EQ(summary.input_steps.size(), 4);  // of 4 samples, two steps in each of two
  EXPECT_DOUBLE_EQ(sortedQuantile(summary.input_sizes, 0.99), 3);
  EXPECT_DOUBLE_EQ(sortedQuantile(summary.output_sizes, 0), 2);
  EXPECT_EQ(sortedQuantile({}, 0.5), 0);
  EXPECT_EQ(summary.covariates, (std::map<std::string, double>{{"load", 5}}));
  EXPECT_FALSE(summary.stamps);
  EXPECT_EQ(summary.experiments, 2);
  EXPECT_EQ(summary.samples, 4);
}

TEST(Traits, AreThoseThatTheEffectsDeclare) {
  EXPECT_EQ(findEffect(all(), Trait::feedback)->name(), "exp_feedback");
  EXPECT_EQ(findEffect(all(), Trait::new_component)->name(), "exp_mode");
  EXPECT_EQ(findEffect(all(), Trait::constant)->name(), "act_offset");
  EXPECT_THROW(findEffect({}, Trait::feedback), std::logic_error);
  EXPECT_TRUE(hasTrait("sens_clip", Trait::output_limit));
  EXPECT_FALSE(hasTrait("sens_clip", Trait::feedback));
  EXPECT_TRUE(hasTrait("plant_parameter_spread", Trait::by_experiment)) << "of any plant";
  EXPECT_FALSE(hasTrait("no_such_effect", Trait::output_limit));
  EXPECT_EQ(findEffect(all(), "act_offset", "")->description().excludes,
            std::vector<std::string>{"sens_bias"});
  EXPECT_EQ(findEffect(all(), "exp_mode", "")->description().least_score, 2.5);
  EXPECT_EQ(findEffect(all(), "act_deadzone", "")->description().least_score, 0);
}

TEST(Traits, TellWhatDiffersByExperimentAndWhatIsALineInTheSpectrum) {
  for (const auto& effect : all()) {
    SCOPED_TRACE(effect->label());
    const std::string& name = effect->name();
    const bool differs = effect->description().variant == "per_experiment" || name == "exp_clock" ||
                         name == "plant_parameter_spread";
    EXPECT_EQ(effect->has(Trait::by_experiment), differs);
    EXPECT_EQ(effect->has(Trait::spectral_line), name == "sens_hum");
  }
}

}  // namespace
}  // namespace uncertainty_identification
