#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::vector<VectorXd> starts(const DataSummary& data) {
  std::vector<VectorXd> all;
  for (int k = 1; k < 10; ++k) {
    VectorXd start(2);
    start << 0.15, 0.1 * k * data.samples * data.sample_time;
    all.push_back(start);
  }
  return all;
}

/// u (1 - share) from a time on.
class ActuatorLoss : public Effect {
 public:
  explicit ActuatorLoss(const DataSummary& data)
      : Effect({"act_loss",
                "",
                "actuator that loses effectiveness during the experiment",
                "Look at the actuator at the time named: a part that came loose, a supply that "
                "broke down.",
                {},
                Stage::actuator,
                ScreeningKind::regression,
                {{"share", "1", 0.1, -3.0, 1.0},
                 {"time", "s", 0.1 * data.samples * data.sample_time, 0.0,
                  data.samples * data.sample_time, false}},
                starts(data)}),
        sample_time_(data.sample_time) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const double first = psi[1] / sample_time_;
    const auto on = (chain->time() - first + 1).max(0.0).min(1.0).eval();
    chain->u.rowwise() *= 1 - psi[0] * on;
  }

 private:
  double sample_time_;
};

const EffectRegistration kRegistration(90, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<ActuatorLoss>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
