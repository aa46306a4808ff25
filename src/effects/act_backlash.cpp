#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// The play operator: the output stays until the input has crossed the gap.
class ActuatorBacklash : public Effect {
 public:
  explicit ActuatorBacklash(const DataSummary& data)
      : Effect({"act_backlash",
                "",
                "backlash (play) between command and plant",
                "Reverse the command slowly and measure how far it goes before the output follows.",
                {},
                Stage::actuator,
                ScreeningKind::regression,
                {{"width", "unit of u", data.input_deviation, 0.0, 10 * data.input_deviation}},
                values({0.1, 0.3, 0.7, 1.4}, data.input_deviation)}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const double half = psi[0] / 2;
    Lanes position = Lanes::Zero();
    for (Eigen::Index t = 0; t < chain->u.cols(); ++t) {
      position = position.max(chain->u.col(t) - half).min(chain->u.col(t) + half);
      chain->u.col(t) = position;
    }
  }
};

const EffectRegistration kRegistration(50, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<ActuatorBacklash>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
