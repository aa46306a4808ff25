// Which of the accepted causes are named, and which only describe.
#include "explanation/verdict.h"

#include <gtest/gtest.h>

#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

/// An effect that does nothing.
class Idle : public Effect {
 public:
  explicit Idle(const std::string& name, const std::vector<Trait>& traits = {})
      : Effect(described(name, traits)) {}
  void apply(const Eigen::VectorXd& /*psi*/, Chain* /*chain*/) const override {}

 private:
  static EffectDescription described(const std::string& name, const std::vector<Trait>& traits) {
    EffectDescription description;
    description.name = name;
    description.traits = traits;
    return description;
  }
};

FoundCause found(const std::string& name, double score) {
  FoundCause cause;
  cause.effect = std::make_shared<Idle>(name);
  cause.score = score;
  return cause;
}

SearchState with(const std::vector<FoundCause>& causes) {
  SearchState state{{}, FitData({}), FitData({}), causes, {}};
  return state;
}

TEST(ReasonNotToName, IsThatTheOrdersWereChosen) {
  FoundCause lag = found("plant_pole", 100);
  EXPECT_EQ(reasonNotToName(lag, with({lag}), {false, true}), "");
  lag.may_be_order = true;
  EXPECT_TRUE(
      test::mentions(reasonNotToName(lag, with({lag}), {false, true}), "orders of the model"));
}

/// 1 % of the squared error at a fit of 80 % is a fit of 80.1 %.
TEST(ReasonNotToName, IsThatAConstantCompletesWhatIsNotNamed) {
  FoundCause offset = found("act_offset", 60), curve = found("act_hammerstein", 60);
  offset.effect = std::make_shared<Idle>("act_offset", std::vector<Trait>{Trait::constant});
  EXPECT_EQ(reasonNotToName(offset, with({curve, offset}), {false, true}), "");
  curve.may_be_order = true;
  EXPECT_TRUE(
      test::mentions(reasonNotToName(offset, with({curve, offset}), {false, true}), "beside"));
}

TEST(ReasonNotToName, IsThatTestsPassWithoutItAndTheSimulationIsTheSame) {
  FoundCause zone = found("act_deadzone", 60);
  const auto reason = [&](bool passed_before) {
    return reasonNotToName(zone, with({zone}), {passed_before, true});
  };
  EXPECT_EQ(reason(true), "") << "nothing was measured";
  zone.gain = Gain();
  zone.gain->nrmse_fit_percent = {80, 80.05};
  EXPECT_TRUE(test::mentions(reason(true), "by 60 nats"));
  EXPECT_EQ(reason(false), "");
  zone.gain->nrmse_fit_percent.after = 80.2;
  EXPECT_EQ(reason(true), "");
  zone.gain->nrmse_fit_percent.after = 80;
  zone.score = 101;
  EXPECT_EQ(reason(true), "") << "far more likely";
  for (const Trait trait :
       {Trait::of_mixture, Trait::by_experiment, Trait::of_noise, Trait::spectral_line}) {
    FoundCause spread = zone;
    spread.score = 60;
    spread.effect = std::make_shared<Idle>("spread", std::vector<Trait>{trait});
    EXPECT_EQ(reasonNotToName(spread, with({spread}), {true, true}), "") << "changes no mean";
  }
}

/// A bias of the sensor has nothing left to describe beside an offset of the actuator, nor the
/// reverse.
TEST(SearchState, ExcludesEffectsThatHaveNothingLeftToDescribe) {
  const auto effect = [](const std::string& name, std::vector<std::string> excludes) {
    EffectDescription description;
    description.name = name;
    description.excludes = std::move(excludes);
    return std::make_shared<Effect>(description);
  };
  FoundCause offset, bias;
  offset.effect = effect("act_offset", {"sens_bias"});
  bias.effect = effect("sens_bias", {});
  EXPECT_TRUE(with({offset}).excludes(*bias.effect));
  EXPECT_TRUE(with({bias}).excludes(*offset.effect));
  EXPECT_FALSE(with({offset}).excludes(*effect("sens_hum", {})));
  EXPECT_FALSE(with({}).excludes(*bias.effect));
}

/// Tests that pass are too weak where a cause that is not named makes the data far more likely.
TEST(DoubtAgreement, IsOfCausesThatChangeEveryExperimentAndAreNotNamed) {
  const auto verdictBeside = [](const FoundCause& cause) {
    Explanation explanation;
    explanation.verdict = Verdict::none;
    doubtAgreement(with({cause}), &explanation);
    return explanation.verdict;
  };
  EXPECT_EQ(verdictBeside(found("act_ratelimit", 100)), Verdict::unknown);
  EXPECT_EQ(verdictBeside(found("act_ratelimit", 20)), Verdict::none);
  FoundCause lag = found("plant_pole", 100);
  lag.may_be_order = true;
  EXPECT_EQ(verdictBeside(lag), Verdict::none);
  FoundCause beside = found("act_ratelimit", 60);
  EXPECT_EQ(verdictBeside(beside), Verdict::unknown);
  beside.gain = Gain();
  beside.gain->nrmse_fit_percent = {80, 80};
  EXPECT_EQ(verdictBeside(beside), Verdict::none) << "the simulation is the same with it";
  for (const Trait trait : {Trait::of_noise, Trait::of_mixture, Trait::by_experiment}) {
    FoundCause other = found("another", 100);
    other.effect = std::make_shared<Idle>("another", std::vector<Trait>{trait});
    EXPECT_EQ(verdictBeside(other), Verdict::none);
  }
}

TEST(ReasonNotToName, IsThatTestsFailAndItMayBeASymptom) {
  const FoundCause first = found("act_deadzone", 100), second = found("sens_hum", 50);
  EXPECT_EQ(reasonNotToName(first, with({first, second}), {false, false}), "");
  EXPECT_EQ(reasonNotToName(second, with({first, second}), {false, true}), "");
  EXPECT_TRUE(
      test::mentions(reasonNotToName(second, with({first, second}), {false, false}), "symptom"));
  const TestsAround found_twice{false, false, false, {second.effect->name()}};
  EXPECT_EQ(reasonNotToName(second, with({first, second}), found_twice), "")
      << "the free simulation shows it, too";
}

/// A resonance that the model lacks leaves nearly a line in the spectrum of the residuals.
TEST(ReasonNotToName, IsThatTestsFailAndALineMayBeAResonance) {
  FoundCause line = found("some_line", 100);
  EXPECT_EQ(reasonNotToName(line, with({line}), {false, false}), "");
  line.effect = std::make_shared<Idle>("some_line", std::vector<Trait>{Trait::spectral_line});
  EXPECT_TRUE(test::mentions(reasonNotToName(line, with({line}), {false, false}), "symptom"));
  EXPECT_EQ(reasonNotToName(line, with({line}), {false, false, true}), "")
      << "which leaves residuals that are not white";
  line.score = 54;
  EXPECT_TRUE(test::mentions(reasonNotToName(line, with({line}), {false, false, true}), "symptom"))
      << "and for a while looks like one";
  FoundCause resonance = found("plant_resonance", 90);
  resonance.may_be_order = true;
  EXPECT_TRUE(test::mentions(reasonNotToName(line, with({line, resonance}), {false, true}),
                             "a resonance that swings on"));
  EXPECT_EQ(reasonNotToName(line, with({line}), {false, true}), "");
}

TEST(ReasonNotToName, IsThatASingleRecordDoesNotTellNoiseFromMisfit) {
  Experiment record;
  record.u = record.y = Eigen::VectorXd::LinSpaced(10, 0, 1);
  record.sample_time = 1;
  FoundCause noise = found("noise_step", 100);
  noise.gain = Gain();
  noise.gain->log_density = 20;
  SearchState state{{}, FitData({record}), FitData({record}), {noise}, {}};
  state.fitted_to = true;
  EXPECT_TRUE(test::mentions(reasonNotToName(noise, state, {false, true}), "single record"));
  EXPECT_EQ(reasonNotToName(found("act_deadzone", 100), state, {false, true}), "");
  state.fitted_to = false;
  EXPECT_EQ(reasonNotToName(noise, state, {false, true}), "") << "another record confirms it";
  noise.gain->log_density = 2;
  EXPECT_TRUE(test::mentions(reasonNotToName(noise, state, {false, true}), "single record"));
  state.train = FitData({record, record});
  EXPECT_EQ(reasonNotToName(noise, state, {false, true}), "");
}

TEST(Conclude, SaysThatWhatIsWrongIsNotNamed) {
  Explanation explanation;
  explanation.checks_after = {{"whiteness", 99, 1e-9, false, ""}};
  conclude(&explanation);
  EXPECT_TRUE(test::mentions(explanation.message, "the catalogue does not describe"));
  conclude(&explanation, true);
  EXPECT_EQ(explanation.verdict, Verdict::unknown);
  EXPECT_TRUE(test::mentions(explanation.message, "reasons that the warnings tell"));
  EXPECT_TRUE(test::mentions(explanation.message, "whiteness"));
}

TEST(Conclude, DoesNotCallExplainedWhatOnlyCausesThatAreNotNamedComplete) {
  Explanation explanation;
  explanation.causes.resize(1);
  explanation.causes[0].name = "act_deadzone";
  explanation.checks_after = {{"whiteness", 1, 0.5, true, ""}};
  conclude(&explanation);
  EXPECT_EQ(explanation.verdict, Verdict::explained);
  conclude(&explanation, true);
  EXPECT_EQ(explanation.verdict, Verdict::partly_explained);
  EXPECT_TRUE(test::mentions(explanation.message, "explains part"));
}

TEST(Parsimony, DoesNotCountWhatOneOrderMoreWouldDescribe) {
  std::vector<FoundCause> causes{found("act_deadzone", 9), found("sens_hum", 9),
                                 found("plant_pole", 9)};
  EXPECT_FALSE(parsimony(with(causes)).passed);
  causes[2].may_be_order = true;
  EXPECT_TRUE(parsimony(with(causes)).passed);
}

/// What is concluded where no cause was found and this check fails.
std::string concluded(const std::string& failed, int delay = 1) {
  Explanation explanation;
  explanation.before.nominal_model.delay = delay;
  explanation.checks_after = {{"whiteness", 0, 1, true, ""}, {failed, 0, 0, false, ""}};
  conclude(&explanation, false);
  EXPECT_EQ(explanation.verdict, Verdict::unknown);
  return explanation.message;
}

TEST(Conclude, TellsWhereOnlyTheNoiseIsNotWhatTheModelAssumes) {
  EXPECT_TRUE(test::mentions(concluded("volatility"), "the plant find nothing wrong"));
  EXPECT_TRUE(test::mentions(concluded("tails"), "these checks fail: tails"));
  EXPECT_FALSE(test::mentions(concluded("dependence on the input"), "find nothing wrong"));
  EXPECT_FALSE(test::mentions(concluded("linearity of predictions"), "find nothing wrong"));
}

TEST(Conclude, TellsSoAlsoWhereACauseIsNotNamed) {
  Explanation explanation;
  explanation.checks_after = {{"volatility", 99, 1e-9, false, ""}};
  conclude(&explanation, true);
  EXPECT_TRUE(test::mentions(explanation.message, "the plant find nothing wrong"));
  EXPECT_TRUE(test::mentions(explanation.message, "for reasons that the warnings tell"));
}

TEST(Conclude, TellsThatOnlyTheDirectionIsNotKnown) {
  EXPECT_TRUE(test::mentions(concluded("direction", 0), "do not show which causes the other"));
  Explanation explanation;
  explanation.before.nominal_model.delay = 3;
  explanation.checks_after = {{"direction", 0, 0, false, ""}};
  conclude(&explanation);
  EXPECT_TRUE(test::mentions(explanation.message, "the model answers later"));
  EXPECT_TRUE(explanation.warnings.empty());
  explanation.checks_after.push_back({"whiteness", 0, 0, false, ""});
  conclude(&explanation);
  ASSERT_EQ(explanation.warnings.size(), 1u);
  EXPECT_TRUE(test::mentions(explanation.warnings[0], "the model answers later"));
}

TEST(TellOddExperiments, AreNoAgreementAndTakeNoCauseAway) {
  Explanation explanation;
  explanation.verdict = Verdict::none;
  explanation.message = "the model agrees";
  tellOddExperiments(&explanation);
  EXPECT_EQ(explanation.verdict, Verdict::none);
  explanation.before.has_odd_experiments = true;
  tellOddExperiments(&explanation);
  EXPECT_EQ(explanation.verdict, Verdict::unknown);
  EXPECT_TRUE(test::mentions(explanation.message, "belong together"));
  EXPECT_TRUE(test::mentions(explanation.message, "Apart from this: the model agrees"));

  Explanation named;
  named.verdict = Verdict::explained;
  named.causes.resize(1);
  named.before.has_odd_experiments = true;
  tellOddExperiments(&named);
  EXPECT_EQ(named.verdict, Verdict::explained);
}

}  // namespace
}  // namespace uncertainty_identification
