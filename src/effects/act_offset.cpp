#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// u + offset.
class ActuatorOffset : public Effect {
 public:
  explicit ActuatorOffset(const DataSummary& data)
      : Effect({"act_offset",
                "",
                "constant added to the actuator's command",
                "Read the actuator with the command at zero; a step of the command from rest tells "
                "it from a bias of the sensor.",
                {"sens_bias"},
                Stage::actuator,
                ScreeningKind::regression,
                {{"offset", "unit of u", data.input_deviation}},
                {VectorXd::Zero(1)}}) {}

  void apply(const VectorXd& psi, Chain* chain) const override { chain->u += psi[0]; }
};

const EffectRegistration kRegistration(10, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<ActuatorOffset>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
