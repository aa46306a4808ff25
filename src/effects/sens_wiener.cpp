#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// x + c2 x^2 + c3 x^3.
class SensorCurve : public Effect {
 public:
  explicit SensorCurve(const DataSummary& data)
      : Effect({"sens_wiener",
                "",
                "curved characteristic of the sensor",
                "Calibrate the sensor at several levels.",
                {},
                Stage::output,
                ScreeningKind::regression,
                {{"c2", "1 per unit of y", 1 / data.output_deviation},
                 {"c3", "1 per unit of y squared", std::pow(data.output_deviation, -2)}},
                {VectorXd::Zero(2)},
                true}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const Signals x = chain->expected();
    chain->transform(x + x.square() * (psi[0] + psi[1] * x), 1 + x * (2 * psi[0] + 3 * psi[1] * x));
  }
};

const EffectRegistration kRegistration(100, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<SensorCurve>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
