#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// u + c2 u^2 + c3 u^3.
class ActuatorCurve : public Effect {
 public:
  explicit ActuatorCurve(const DataSummary& data)
      : Effect({"act_hammerstein",
                "",
                "curved characteristic of the actuator",
                "Measure the actuator's static characteristic, command against force, flow or "
                "current.",
                {},
                Stage::actuator,
                ScreeningKind::regression,
                {{"c2", "1 per unit of u", 1 / data.input_deviation},
                 {"c3", "1 per unit of u squared", std::pow(data.input_deviation, -2)}},
                {VectorXd::Zero(2)}}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const Signals& u = chain->u;
    chain->u = u + u.square() * (psi[0] + psi[1] * u);
  }
};

const EffectRegistration kRegistration(80, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<ActuatorCurve>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
