#include <cmath>

#include "model/filter.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// u(t - delay), linear between samples.
class ActuatorDelay : public Effect {
 public:
  explicit ActuatorDelay(const DataSummary& data)
      : Effect({"act_delay",
                "",
                "dead time that the model lacks",
                "Compare the stamps of command and measurement, and look for transport or "
                "communication delays.",
                {"plant_pole", "sens_lag"},
                Stage::actuator,
                ScreeningKind::regression,
                {{"delay", "samples", 0.3, 0.0, data.samples / 4.0}},
                values({0.3, 0.7, 1, 1.5, 2, 3, 4, 5, 7, 10})}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const int whole = static_cast<int>(psi[0]);
    const double rest = psi[0] - whole;
    const Signals u = chain->u;
    chain->u.setZero();
    addShifted(1 - rest, whole, u, &chain->u);
    addShifted(rest, whole + 1, u, &chain->u);
  }
};

const EffectRegistration kRegistration(20, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<ActuatorDelay>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
