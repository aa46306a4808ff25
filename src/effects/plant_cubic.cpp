#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// The plant's input less stiffness x^3, x its output: a spring that hardens or softens.
class PlantCubic : public Effect {
 public:
  explicit PlantCubic(const DataSummary& data)
      : Effect({"plant_cubic",
                "",
                "stiffness of the plant that depends on its deflection",
                "Repeat an experiment at half and at twice the amplitude.",
                {},
                Stage::loop,
                ScreeningKind::regression,
                {{"stiffness", "unit of u per cubed unit of y",
                  data.input_deviation * std::pow(data.output_deviation, -3)}},
                values({0.02, 0.15, -0.02},
                       data.input_deviation * std::pow(data.output_deviation, -3)),
                true}),
        largest_(8 * data.output_deviation) {}

  Lanes feedback(const VectorXd& psi, const Lanes& x, const Lanes& /*before*/) const override {
    return psi[0] * x.min(largest_).max(-largest_).cube();
  }

 private:
  double largest_;
};

const EffectRegistration kRegistration(10, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<PlantCubic>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
