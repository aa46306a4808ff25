#include "effects/built_in_effects.h"

namespace uncertainty_identification {
namespace {

struct Text {
  const char *name, *meaning, *advice;
  std::vector<std::string> equivalent;
  std::vector<Trait> traits;
  double least_score = 0;
};

std::vector<Text> texts() {
  return {
      {"sens_quant",
       "sensor that reads in steps",
       "Use more bits or a smaller range, or add some noise (dither) before the converter.",
       {},
       {Trait::quantisation}},
      {"sens_dropout",
       "sensor that holds its last value",
       "Look for lost messages or a sensor slower than the sampling.",
       {},
       {Trait::held_samples}},
      {"sens_outliers",
       "single readings that are wrong",
       "Look for contact problems, checksum errors, or electrical interference.",
       {"noise_tails"},
       {Trait::of_noise, Trait::outliers}},
      {"noise_tails",
       "noise with heavier tails than Gaussian, as shocks and load steps have",
       "Look for shocks, switching and load steps; record the load as a covariate.",
       {"sens_outliers"},
       {Trait::of_noise, Trait::heavy_tails}},
      {"exp_mode",
       "another kind of plant among the experiments (one more mixture component)",
       "Find out what the experiments of this component have in common.",
       {},
       {Trait::of_mixture, Trait::new_component},
       2.5},  // a test by bootstrap follows
      {"exp_feedback",
       "input that depends on the output (closed loop)",
       "Record the reference signal and use it as the input, or add a known excitation; "
       "estimates are consistent only if the noise model is right.",
       {},
       {Trait::feedback}},
  };
}

}  // namespace

/// Effects that are not part of the chain. The explanation looks for them in the samples, in the
/// residual distribution, in the mixture of plants and in the dependence of the input on the
/// output.
MadeEffects effectsOutsideTheChain(const DataSummary& /*data*/) {
  MadeEffects all;
  for (const Text& text : texts()) {
    EffectDescription description;
    description.name = text.name;
    description.meaning = text.meaning;
    description.advice = text.advice;
    description.equivalent = text.equivalent;
    description.traits = text.traits;
    description.least_score = text.least_score;
    description.stage = Stage::data;
    all.push_back(std::make_shared<Effect>(description));
  }
  return all;
}

}  // namespace uncertainty_identification
