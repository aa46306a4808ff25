// Which gains on held-out experiments make a candidate a cause, and how sure that is.
#include "explanation/acceptance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace uncertainty_identification {
namespace {

/// An effect that does nothing.
class Named : public Effect {
 public:
  explicit Named(const std::string& name, std::vector<Trait> traits = {},
                 Stage stage = Stage::actuator)
      : Effect(described(name, std::move(traits), stage)) {}
  void apply(const Eigen::VectorXd& /*psi*/, Chain* /*chain*/) const override {}

 private:
  static EffectDescription described(const std::string& name, std::vector<Trait> traits,
                                     Stage stage) {
    EffectDescription description;
    description.name = name;
    description.stage = stage;
    description.traits = std::move(traits);
    return description;
  }
};

Gain gainOf(double value, double standard_error) {
  Gain gain;
  gain.log_density = value;
  gain.standard_error = standard_error;
  return gain;
}

FittedEffect scored(const std::string& name, double score, std::vector<Trait> traits = {}) {
  FittedEffect candidate;
  candidate.effect = std::make_shared<Named>(name, std::move(traits));
  candidate.score = score;
  return candidate;
}

TEST(AcceptanceRules, CompareTheGainWithItsStandardError) {
  EXPECT_TRUE(passes(gainOf(1.7, 1), AcceptanceRule::significant_gain));
  EXPECT_FALSE(passes(gainOf(1.6, 1), AcceptanceRule::significant_gain));
  EXPECT_TRUE(passes(gainOf(0.1, 1), AcceptanceRule::any_gain));
  EXPECT_FALSE(passes(gainOf(-0.1, 1), AcceptanceRule::any_gain));
  EXPECT_TRUE(passes(gainOf(-1.9, 1), AcceptanceRule::no_significant_loss));
  EXPECT_FALSE(passes(gainOf(-2.1, 1), AcceptanceRule::no_significant_loss));
}

TEST(AcceptanceRules, AskForAGainWhereThereIsNoStandardError) {
  EXPECT_TRUE(passes(gainOf(0.1, std::nan("")), AcceptanceRule::significant_gain));
  EXPECT_FALSE(passes(gainOf(-0.1, std::nan("")), AcceptanceRule::no_significant_loss));
}

Gain simulated(double before, double after) {
  Gain gain;
  gain.nrmse_fit_percent = {before, after};
  return gain;
}

// 20 % are left over at a fit of 80 %; a hundredth more in the square is 79.9 %, a tenth 79.02 %.
TEST(AcceptanceRules, RefuseWhatSimulatesWorse) {
  EXPECT_TRUE(simulatesAsWell(Named("act_deadzone"), simulated(80, 79.91)));
  EXPECT_FALSE(simulatesAsWell(Named("act_deadzone"), simulated(80, 79.89)));
  EXPECT_TRUE(simulatesAsWell(Named("noise_colour", {Trait::of_noise}), simulated(80, 79.1)));
  EXPECT_FALSE(simulatesAsWell(Named("noise_colour", {Trait::of_noise}), simulated(80, 78.9)));
  EXPECT_FALSE(simulatesAsWell(Named("act_deadzone"), simulated(80, std::nan(""))));
}

/// A hundredth less in the square than at a fit of 80 % is 80.1 %.
TEST(AcceptanceRules, RefuseWhatExplainsMuchOfTheNoiseAndNothingOfTheSimulation) {
  const auto gained = [](double fit, double noise, double before = 80) {
    Gain gain = simulated(before, fit);
    gain.noise_variance = {1, noise};
    return gain;
  };
  EXPECT_TRUE(simulatesAsWell(Named("act_deadzone"), gained(24.5, 0.7, 24.4))) << "plants differ";
  EXPECT_TRUE(simulatesAsWell(Named("act_deadzone"), gained(80.11, 0.79)));
  EXPECT_FALSE(simulatesAsWell(Named("act_deadzone"), gained(80.09, 0.79)));
  EXPECT_TRUE(simulatesAsWell(Named("act_deadzone"), gained(80.09, 0.81)));
  EXPECT_TRUE(simulatesAsWell(Named("plant_pole", {Trait::order}), gained(80.09, 0.79)));
  EXPECT_TRUE(simulatesAsWell(Named("sens_drift", {}, Stage::output), gained(80.09, 0.79)));
}

/// What states a record may begin from is not known, so that a constant beside the model's offset
/// raises the likelihood wherever it makes these more usual.
TEST(AcceptanceRules, AskAConstantForABetterSimulation) {
  const Named offset("act_offset", {Trait::constant});
  EXPECT_FALSE(simulatesAsWell(offset, simulated(80, 80.4)));
  EXPECT_TRUE(simulatesAsWell(offset, simulated(80, 80.6)));
}

TEST(AcceptanceRules, ACauseHoldsWhileItNeitherLosesDensityNorFit) {
  Gain gain = gainOf(-1, 1);
  gain.nrmse_fit_percent = {80, 81};
  EXPECT_TRUE(stillHolds(Named("act_deadzone"), gain));
  gain.nrmse_fit_percent.after = 79;
  EXPECT_FALSE(stillHolds(Named("act_deadzone"), gain));
  gain = gainOf(-1e300, 9.7);
  gain.nrmse_fit_percent = {80, 81};
  EXPECT_FALSE(stillHolds(Named("act_deadzone"), gain));
}

// 95 % of the squared error at a fit of 80 % are left at 80.5 %: 19.5^2 / 20^2 = 0.951.
TEST(AcceptanceRules, ClearIsATwentiethOfTheSquaredErrorOrThreeStandardErrors) {
  const auto gained = [](double after, double density) {
    Gain gain = gainOf(density, 1);
    gain.nrmse_fit_percent = {80, after};
    return gain;
  };
  EXPECT_TRUE(isClear(gained(80.6, 2)));
  EXPECT_FALSE(isClear(gained(80.4, 2)));
  EXPECT_TRUE(isClear(gained(80, 3.1)));
  EXPECT_FALSE(isClear(gained(80, 2.9)));
  EXPECT_FALSE(isClear(gained(std::nan(""), 2)));
}

TEST(AcceptanceRules, DependOnTheEffectAndItsScore) {
  EXPECT_EQ(acceptanceRule(Named("act_deadzone"), 14), AcceptanceRule::significant_gain);
  EXPECT_EQ(acceptanceRule(Named("act_deadzone"), 16), AcceptanceRule::any_gain);
  EXPECT_EQ(acceptanceRule(Named("exp_mode", {Trait::of_mixture}), 16),
            AcceptanceRule::no_significant_loss);
}

TEST(Equivalence, IsThatOfScoresThatAreNear) {
  const std::vector<FittedEffect> ranked{scored("act_deadzone", 10), scored("act_backlash", 9)};
  EXPECT_EQ(equivalentOf(ranked[0], ranked), std::vector<std::string>{"act_backlash"});
}

/// What a model of higher order has as well is no cause where the orders are not known.
TEST(Equivalence, ToAnOrderIsThatOfSuchAnEffectOrOfOneThatIsNear) {
  const FittedEffect spread = scored("plant_parameter_spread", 10);
  FittedEffect lag = scored("plant_pole", 9, {Trait::order});
  EXPECT_TRUE(mayBeOrder(lag, {lag}));
  EXPECT_TRUE(mayBeOrder(spread, {spread, lag}));
  lag.score = 3;
  EXPECT_FALSE(mayBeOrder(spread, {spread, lag}));
}

TEST(Equivalence, EffectsOfAMuchLowerScoreAreNotEquivalent) {
  const std::vector<FittedEffect> ranked{scored("act_deadzone", 10), scored("act_backlash", 3)};
  EXPECT_TRUE(equivalentOf(ranked[0], ranked).empty());
}

}  // namespace
}  // namespace uncertainty_identification
