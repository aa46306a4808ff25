#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::vector<VectorXd> limits(const DataSummary& data) {
  std::vector<VectorXd> all;
  for (const double q : {0.6, 0.75, 0.85, 0.92, 0.97})
    all.push_back(VectorXd::Constant(
        1, std::max(sortedQuantile(data.output_sizes, q), 1e-3 * data.output_deviation)));
  return all;
}

/// x clipped at +-limit before noise is added.
class SensorClipping : public Effect {
 public:
  explicit SensorClipping(const DataSummary& data)
      : Effect({"sens_clip",
                "",
                "sensor that runs into its limit",
                "Choose a wider range of the sensor, or excite less.",
                {},
                Stage::output,
                ScreeningKind::regression,
                {{"limit", "unit of y", data.output_deviation, 1e-3 * data.output_deviation,
                  100 * data.output_deviation}},
                limits(data),
                true}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const Signals x = chain->expected();
    chain->transform(x.min(psi[0]).max(-psi[0]), (x.abs() < psi[0]).cast<double>());
  }
};

const EffectRegistration kRegistration(110, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<SensorClipping>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
