#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::vector<VectorXd> rates(const DataSummary& data) {
  std::vector<VectorXd> all;
  for (const double q : {0.3, 0.5, 0.7, 0.85, 0.95})
    all.push_back(VectorXd::Constant(
        1, std::max(sortedQuantile(data.input_steps, q), 1e-3 * data.input_deviation)));
  for (const double share : {0.1, 0.3, 1.0})
    all.push_back(VectorXd::Constant(1, share * data.input_deviation));
  return all;
}

/// Follows the command by at most `rate` per sample.
class ActuatorRateLimit : public Effect {
 public:
  explicit ActuatorRateLimit(const DataSummary& data)
      : Effect({"act_ratelimit",
                "",
                "limited rate of the actuator",
                "Step the command and record the actuator's own position.",
                {},
                Stage::actuator,
                ScreeningKind::regression,
                {{"rate", "unit of u per sample", data.input_deviation, 1e-4 * data.input_deviation,
                  100 * data.input_deviation}},
                rates(data)}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    Lanes position = Lanes::Zero();
    for (Eigen::Index t = 0; t < chain->u.cols(); ++t) {
      position += (chain->u.col(t) - position).min(psi[0]).max(-psi[0]);
      chain->u.col(t) = position;
    }
  }
};

const EffectRegistration kRegistration(60, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<ActuatorRateLimit>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
