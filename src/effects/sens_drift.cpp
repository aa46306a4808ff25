#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// y + drift t/N.
class SensorDrift : public Effect {
 public:
  explicit SensorDrift(const DataSummary& data)
      : Effect({"sens_drift",
                "",
                "sensor that drifts during each experiment",
                "Let the sensor warm up; record it with the plant at rest for as long as an "
                "experiment.",
                {},
                Stage::output,
                ScreeningKind::regression,
                {{"drift", "unit of y per experiment", data.output_deviation}},
                {VectorXd::Zero(1)}}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    chain->x += psi[0] * chain->relativeTime();
  }
};

/// y + s_r t/N, s_r random.
class OwnSensorDrift : public Effect {
 public:
  OwnSensorDrift()
      : Effect({"sens_drift",
                "per_experiment",
                "drift of the sensor that differs by experiment",
                "Let the sensor warm up; record it with the plant at rest for as long as an "
                "experiment.",
                {},
                Stage::output,
                ScreeningKind::likelihood,
                {logVariance("deviation", "unit of y per experiment")},
                values({-4, -2, 1, 4})}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    chain->random.push_back({chain->relativeTime(), std::exp(psi[0])});
  }
};

const EffectRegistration kRegistration(130, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<SensorDrift>(data), std::make_shared<OwnSensorDrift>()};
});
}  // namespace
}  // namespace uncertainty_identification
