#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::vector<VectorXd> widths(const DataSummary& data) {
  std::vector<VectorXd> all;
  for (const double q : {0.05, 0.12, 0.2, 0.3, 0.45})
    all.push_back(VectorXd::Constant(
        1, std::max(sortedQuantile(data.input_sizes, q), 0.02 * data.input_deviation)));
  for (const double share : {0.1, 0.2})
    all.push_back(VectorXd::Constant(1, share * data.input_deviation));
  return all;
}

/// sign(u) max(|u| - width, 0).
class ActuatorDeadZone : public Effect {
 public:
  explicit ActuatorDeadZone(const DataSummary& data)
      : Effect({"act_deadzone",
                "",
                "dead zone of the actuator",
                "Raise the command slowly from zero and note where the output begins to move.",
                {},
                Stage::actuator,
                ScreeningKind::regression,
                {{"width", "unit of u", data.input_deviation, 0.0, 5 * data.input_deviation}},
                widths(data)}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const Signals& u = chain->u;
    chain->u = (u - psi[0]).max(0.0) + (u + psi[0]).min(0.0);
  }
};

const EffectRegistration kRegistration(40, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<ActuatorDeadZone>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
