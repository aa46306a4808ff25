#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

/// Effects that are no part of the chain: found in the samples themselves, in the mixture, or in
/// the way the input was made (explanation/).
MadeEffects outsideTheChain() {
  struct Text {
    const char *name, *meaning, *advice;
    std::vector<std::string> equivalent;
  };
  MadeEffects all;
  for (const Text& text : {
           Text{"sens_quant",
                "sensor that reads in steps",
                "Use more bits or a smaller range, or let the dither of some noise pass before the "
                "converter.",
                {}},
           Text{"sens_dropout",
                "sensor that holds its last value",
                "Look for lost messages or a sensor slower than the sampling.",
                {}},
           Text{"sens_outliers",
                "single readings that are wrong",
                "Look for contact problems, checksum errors, or electrical interference.",
                {"noise_tails"}},
           Text{"noise_tails",
                "noise with heavier tails than Gaussian",
                "Estimate robustly; look for shocks and switching.",
                {"sens_outliers"}},
           Text{"exp_mode",
                "one more kind of plant behaviour among the experiments",
                "Find out what the experiments of this component have in common.",
                {}},
           Text{"exp_feedback",
                "input that depends on the output (closed loop)",
                "Record the reference signal and use it as the input, or add a known excitation; "
                "estimates are consistent only if the noise model is right.",
                {}},
       }) {
    EffectDescription description;
    description.name = text.name;
    description.meaning = text.meaning;
    description.advice = text.advice;
    description.equivalent = text.equivalent;
    description.stage = Stage::data;
    all.push_back(std::make_shared<Effect>(description));
  }
  return all;
}

const EffectRegistration kRegistration(10, [](const DataSummary&) { return outsideTheChain(); });

}  // namespace
}  // namespace uncertainty_identification
