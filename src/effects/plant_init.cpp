#include <cmath>

#include "model/filter.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// x + c_r times the impulse response of 1/A, c_r random.
class PlantInitialState : public Effect {
 public:
  PlantInitialState()
      : Effect({"plant_init",
                "",
                "plant that is not at rest when an experiment begins",
                "Wait longer before an experiment, or set estimation.initial_state: estimate.",
                {},
                Stage::output,
                ScreeningKind::likelihood,
                {logVariance("deviation", "unit of y")},
                values({-2, 1, 4, 8})}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    Signals impulse = Signals::Zero(kLanes, chain->x.cols()), z;
    impulse.col(0).setOnes();
    filter(VectorXd::Ones(1), chain->nominal.polynomials(chain->theta).a, 0, impulse, &z);
    chain->random.push_back({z, std::exp(psi[0])});
  }
};

const EffectRegistration kRegistration(40, [](const DataSummary&) -> MadeEffects {
  return {std::make_shared<PlantInitialState>()};
});
}  // namespace
}  // namespace uncertainty_identification
