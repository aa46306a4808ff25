#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::vector<VectorXd> steps(double deviation) {
  constexpr int kCount = 45;
  std::vector<VectorXd> all;
  all.reserve(kCount);
  for (int k = 0; k < kCount; ++k)
    all.push_back(VectorXd::Constant(1, 0.12 * deviation * std::pow(20.0, k / (kCount - 1.0))));
  return all;
}

/// step round(u/step).
class ActuatorQuantisation : public Effect {
 public:
  explicit ActuatorQuantisation(const DataSummary& data)
      : Effect({"act_quantisation",
                "",
                "actuator that moves in steps",
                "Check the resolution of the actuator's command (converter, valve positioner, "
                "integer message).",
                {},
                Stage::actuator,
                ScreeningKind::regression,
                {{"step", "unit of u", data.input_deviation, 1e-6 * data.input_deviation,
                  10 * data.input_deviation, false}},
                steps(data.input_deviation)}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    chain->u = psi[0] * (chain->u / psi[0]).round();
  }
};

const EffectRegistration kRegistration(30, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<ActuatorQuantisation>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
