#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::vector<VectorXd> starts(const DataSummary& data) {
  std::vector<VectorXd> all;
  for (const double width : {0.05, 0.3}) {
    VectorXd start(2);
    start << 0.1 * data.input_deviation, width * data.output_deviation;
    all.push_back(start);
  }
  return all;
}

/// The plant's input less friction tanh(v/width), v the change of the output per sample.
class PlantCoulomb : public Effect {
 public:
  explicit PlantCoulomb(const DataSummary& data)
      : Effect({"plant_coulomb",
                "",
                "Coulomb friction in the plant",
                "Move slowly in both directions: the force needed does not vanish with the speed.",
                {},
                Stage::loop,
                ScreeningKind::regression,
                {{"friction", "unit of u", 0.1 * data.input_deviation},
                 {"width", "unit of y per sample", 0.1 * data.output_deviation,
                  0.005 * data.output_deviation, 10 * data.output_deviation}},
                starts(data),
                true}) {}

  Lanes feedback(const VectorXd& psi, const Lanes& x, const Lanes& before) const override {
    return psi[0] * (1 - 2 / ((2 / psi[1] * (x - before)).min(60.0).exp() + 1));
  }
};

const EffectRegistration kRegistration(20, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<PlantCoulomb>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
