#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

enum class Driver { input, output };

/// Variance 1 - share + share (driver/deviation of the driver)^2.
class NoiseLevel : public Effect {
 public:
  NoiseLevel(Driver driver, const DataSummary& data)
      : Effect(
            {"noise_hetero",
             driver == Driver::input ? "u" : "x",
             std::string("noise that grows with the ") +
                 (driver == Driver::input ? "input" : "output"),
             "Look for noise of the actuator, or a sensor whose error is a share of its reading.",
             {},
             Stage::noise,
             ScreeningKind::likelihood,
             {{"share", "1", 0.2, 0.0, 0.995}},
             values({0.1, 0.3, 0.6, 0.85}),
             driver == Driver::output}),
        driver_(driver),
        deviation_(driver == Driver::input ? data.input_deviation : data.output_deviation) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const Signals driver =
        (driver_ == Driver::input ? chain->block.u : chain->expected()) / deviation_;
    chain->scaleDeviation((1 - psi[0] + psi[0] * driver.square()).max(1e-4).sqrt());
  }

 private:
  Driver driver_;
  double deviation_;
};

const EffectRegistration kRegistration(10, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<NoiseLevel>(Driver::input, data),
          std::make_shared<NoiseLevel>(Driver::output, data)};
});
}  // namespace
}  // namespace uncertainty_identification
