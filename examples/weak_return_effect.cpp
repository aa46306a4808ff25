// An effect of one's own: an actuator that pulls less than it pushes. A hydraulic cylinder does so,
// because its rod covers part of the piston. docs/adding_an_effect.md explains each part.

#include <memory>

#include "uncertainty_identification/effects/catalogue.h"

namespace {

namespace ui = uncertainty_identification;

/// u where it is positive, (1 - share) u where it is negative.
class WeakReturn : public ui::Effect {
 public:
  WeakReturn()
      : Effect({"act_weak_return",
                "",
                "actuator that is weaker in the negative direction",
                "Command the same step in both directions and compare the forces.",
                {"act_hammerstein"},
                ui::Stage::actuator,
                ui::ScreeningKind::regression,
                {{"share", "1", 0.1, -1.0, 1.0}},
                {Eigen::VectorXd::Zero(1)}}) {}

  void apply(const Eigen::VectorXd& psi, ui::Chain* chain) const override {
    chain->u = chain->u.max(0.0) + (1 - psi[0]) * chain->u.min(0.0);
  }
};

/// The rod's side of the piston pulls less, but the valve in front of it may have a dead zone.
const ui::EffectRegistration kRegistration(ui::After{"act_deadzone"},
                                           [](const ui::DataSummary&) -> ui::MadeEffects {
                                             return {std::make_shared<WeakReturn>()};
                                           });

}  // namespace
