#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::vector<VectorXd> limits(const DataSummary& data) {
  std::vector<VectorXd> all;
  for (const double q : {0.4, 0.55, 0.7, 0.8, 0.88, 0.94, 0.98})
    all.push_back(VectorXd::Constant(
        1, std::max(sortedQuantile(data.input_sizes, q), 1e-3 * data.input_deviation)));
  return all;
}

/// The command clipped at +-limit.
class ActuatorSaturation : public Effect {
 public:
  explicit ActuatorSaturation(const DataSummary& data)
      : Effect({"act_saturation",
                "",
                "saturation of the actuator",
                "Compare the largest commands with the actuator's rating, or command less.",
                {},
                Stage::actuator,
                ScreeningKind::regression,
                {{"limit", "unit of u", data.input_deviation, 1e-3 * data.input_deviation,
                  100 * data.input_deviation}},
                limits(data)}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    chain->u = chain->u.min(psi[0]).max(-psi[0]);
  }
};

const EffectRegistration kRegistration(70, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<ActuatorSaturation>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
