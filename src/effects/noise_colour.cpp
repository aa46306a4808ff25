#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"
#include "uncertainty_identification/model/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// D (1 + d1 q^-1 + d2 q^-2).
class NoiseColour : public Effect {
 public:
  NoiseColour()
      : Effect(
            {"noise_colour",
             "",
             "disturbance that is coloured other than the noise model says",
             "Raise the order of the noise model (nc, nd), or look for the disturbance's source.",
             {},
             Stage::measurement,
             ScreeningKind::regression,
             {{"d1", "1", 0.2}, {"d2", "1", 0.2}},
             {VectorXd::Zero(2)}}) {}

  bool admissible(const VectorXd& psi) const override { return isStable(psi, 0.999); }

  void apply(const VectorXd& psi, Chain* chain) const override {
    chain->noise_d = multiply(chain->noise_d, psi);
  }
};

const EffectRegistration kRegistration(20, [](const DataSummary&) -> MadeEffects {
  return {std::make_shared<NoiseColour>()};
});
}  // namespace
}  // namespace uncertainty_identification
