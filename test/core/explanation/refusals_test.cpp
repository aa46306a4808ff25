// Which candidates are refused although they raise the likelihood.
#include "explanation/refusals.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

/// An effect that does nothing.
class Nothing : public Effect {
 public:
  Nothing(const std::string& name, const std::string& variant) : Effect(described(name, variant)) {}
  void apply(const Eigen::VectorXd& /*psi*/, Chain* /*chain*/) const override {}

 private:
  static EffectDescription described(const std::string& name, const std::string& variant) {
    EffectDescription description;
    description.name = name;
    description.variant = variant;
    return description;
  }
};

FittedEffect scoredEffect(const std::string& name, double score, const std::string& variant = "") {
  FittedEffect candidate;
  candidate.effect = std::make_shared<Nothing>(name, variant);
  candidate.score = score;
  return candidate;
}

Gain gainOf(double before, double after, double density) {
  Gain gain;
  gain.nrmse_fit_percent = {before, after};
  gain.log_density = density;
  gain.standard_error = 1;
  return gain;
}

TEST(Refusals, AreDueWhereTheSimulationGetsWorse) {
  const FittedEffect candidate = scoredEffect("act_deadzone", 20);
  EXPECT_TRUE(Refusals().isDue(candidate, gainOf(80, 79, 50), {candidate}));
  EXPECT_FALSE(Refusals().isDue(candidate, gainOf(80, 81, 50), {candidate}));
}

TEST(Refusals, OutshineOtherEffectsUnlessTheirGainIsClear) {
  const FittedEffect refused = scoredEffect("sens_hum", 100);
  const FittedEffect weak = scoredEffect("act_deadzone", 20),
                     near = scoredEffect("act_deadzone", 95);
  const std::vector<FittedEffect> ranked{refused, weak};
  Refusals refusals;
  EXPECT_FALSE(refusals.isDue(weak, gainOf(80, 80.1, 2), ranked)) << "nothing was refused yet";
  refusals.add(*refused.effect, gainOf(80, 70, 50));
  EXPECT_TRUE(refusals.isDue(weak, gainOf(80, 80.1, 2), ranked));
  EXPECT_FALSE(refusals.isDue(weak, gainOf(80, 85, 2), ranked)) << "simulates much better";
  EXPECT_FALSE(refusals.isDue(weak, gainOf(80, 80.1, 4), ranked)) << "four standard errors";
  EXPECT_FALSE(refusals.isDue(near, gainOf(80, 80.1, 2), {refused, near})) << "as good";
  const FittedEffect other_form = scoredEffect("sens_hum", 20, "per_experiment");
  EXPECT_FALSE(refusals.isDue(other_form, gainOf(80, 80.1, 2), {refused, other_form}));
}

TEST(Refusals, AreLeftOutOfTheCandidatesAndTold) {
  Refusals refusals;
  const FittedEffect hum = scoredEffect("sens_hum", 100, "per_experiment"),
                     lag = scoredEffect("sens_lag", 20);
  refusals.add(*hum.effect, gainOf(90, 87.63, 50));
  const std::vector<FittedEffect> left = refusals.left({hum, lag});
  ASSERT_EQ(left.size(), 1u);
  EXPECT_EQ(left[0].effect, lag.effect);
  const std::vector<std::string> warnings = refusals.warnings({"sens_lag"});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("sens_hum (per_experiment) raises the likelihood, but"), 0u);
  EXPECT_NE(warnings[0].find("(fit 90 % before, 87.6 % after)"), std::string::npos) << warnings[0];
  EXPECT_TRUE(refusals.warnings({"sens_hum (per_experiment)"}).empty());
  refusals.remove(*hum.effect);
  EXPECT_EQ(refusals.left({hum, lag}).size(), 2u);
}

}  // namespace
}  // namespace uncertainty_identification
