#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// An extra lag behind the plant: (1 - pole)/(1 - pole q^-1).
class PlantPole : public Effect {
 public:
  PlantPole()
      : Effect({"plant_pole",
                "",
                "lag of the plant that the model lacks",
                "Raise the order of the model by one, or look for a slow actuator or filter.",
                {"sens_lag", "act_delay"},
                Stage::plant,
                ScreeningKind::regression,
                {{"pole", "1", 0.2, -0.9, 0.99}},
                values({0.15, 0.5, 0.8})}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    chain->filterOutput(VectorXd::Constant(1, 1 - psi[0]), -psi);
  }
};

const EffectRegistration kRegistration(20, [](const DataSummary&) -> MadeEffects {
  return {std::make_shared<PlantPole>()};
});
}  // namespace
}  // namespace uncertainty_identification
