#include <cmath>

#include "model/filter.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// The sensor puts x + v through (1 - pole)/(1 - pole q^-1); the measurement is put back through
/// its inverse. A pole near 1 would difference the data and absorb any drift.
class SensorLag : public Effect {
 public:
  SensorLag()
      : Effect({"sens_lag",
                "",
                "lag of the sensor",
                "Look up the sensor's time constant or filter setting; it colours the noise as "
                "well.",
                {"plant_pole", "act_delay"},
                Stage::measurement,
                ScreeningKind::regression,
                {{"pole", "1", 0.2, -0.9, 0.93}},
                values({0.15, 0.5, 0.8})}) {}

  void sense(const VectorXd& psi, Signals* signal) const override {
    Signals out;
    filter(VectorXd::Constant(1, 1 - psi[0]), -psi, 0, *signal, &out);
    signal->swap(out);
  }

  void apply(const VectorXd& psi, Chain* chain) const override {
    const Signals measured = chain->y.size() > 0 ? chain->y : chain->block.y;
    Signals before;
    shift(1, measured, &before);
    chain->y = (measured - psi[0] * before) / (1 - psi[0]);
    chain->log_jacobian -= chain->block.weight.rowwise().sum() * std::log(1 - psi[0]);
  }
};

const EffectRegistration kRegistration(10, [](const DataSummary&) -> MadeEffects {
  return {std::make_shared<SensorLag>()};
});
}  // namespace
}  // namespace uncertainty_identification
