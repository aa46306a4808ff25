#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// y + bias.
class SensorBias : public Effect {
 public:
  explicit SensorBias(const DataSummary& data)
      : Effect({"sens_bias",
                "",
                "constant bias of the sensor",
                "Read the sensor with the plant at rest; or set estimation.offsets: estimate.",
                {"act_offset"},
                Stage::output,
                ScreeningKind::regression,
                {{"bias", "unit of y", data.output_deviation}},
                {VectorXd::Zero(1)}}) {}

  void apply(const VectorXd& psi, Chain* chain) const override { chain->x += psi[0]; }
};

/// y + b_r, b_r random.
class OwnSensorBias : public Effect {
 public:
  OwnSensorBias()
      : Effect({"sens_bias",
                "per_experiment",
                "bias of the sensor that differs by experiment",
                "Zero the sensor before each experiment; or set estimation.offsets: "
                "per_experiment.",
                {},
                Stage::output,
                ScreeningKind::likelihood,
                {logVariance("deviation", "unit of y")},
                values({-4, -2, 1, 4})}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    chain->random.push_back({Signals::Ones(kLanes, chain->x.cols()), std::exp(psi[0])});
  }
};

const EffectRegistration kRegistration(120, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<SensorBias>(data), std::make_shared<OwnSensorBias>()};
});
}  // namespace
}  // namespace uncertainty_identification
