#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// Gain 1 + slope (t/N - 1/2) over each experiment.
class PlantDrift : public Effect {
 public:
  PlantDrift()
      : Effect({"plant_drift",
                "",
                "gain of the plant that drifts during each experiment",
                "Look for what warms up, wears or empties within one experiment.",
                {},
                Stage::actuator,
                ScreeningKind::regression,
                {{"slope", "relative gain per experiment", 0.3, -1.9, 1.9}},
                {VectorXd::Zero(1)}}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    chain->u *= 1 + psi[0] * (chain->relativeTime() - 0.5);
  }
};

const EffectRegistration kRegistration(100, [](const DataSummary&) -> MadeEffects {
  return {std::make_shared<PlantDrift>()};
});
}  // namespace
}  // namespace uncertainty_identification
