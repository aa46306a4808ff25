#include <cmath>

#include "model/filter.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::vector<VectorXd> starts(const DataSummary& data) {
  std::vector<VectorXd> all;
  constexpr int kCount = 30;
  for (int k = 0; k < kCount; ++k) {
    VectorXd start = VectorXd::Zero(4);
    start.head(2) << 0.95, (0.1 + 2.9 * k / (kCount - 1.0)) / data.sample_time;
    all.push_back(start);
  }
  return all;
}

/// In parallel to Go: (g1 q^-1 + g2 q^-2)/(1 - 2 radius cos(w) q^-1 + radius^2 q^-2).
class PlantResonance : public Effect {
 public:
  explicit PlantResonance(const DataSummary& data)
      : Effect({"plant_resonance",
                "",
                "resonance of the plant that the model lacks",
                "Excite at the frequency named and watch what vibrates.",
                {},
                Stage::plant,
                ScreeningKind::regression,
                {{"radius", "1", 0.05, 0.3, 0.9985},
                 {"frequency", "rad/s", 0.1 / data.sample_time, 0.01 / data.sample_time,
                  3.14 / data.sample_time},
                 {"g1", "unit of y per unit of u", gain(data)},
                 {"g2", "unit of y per unit of u", gain(data)}},
                starts(data)}),
        sample_time_(data.sample_time) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    VectorXd numerator = VectorXd::Zero(3), denominator(2);
    numerator.tail(2) = psi.tail(2);
    denominator << -2 * psi[0] * std::cos(psi[1] * sample_time_), psi[0] * psi[0];
    Signals beside;
    filter(numerator, denominator, 0, chain->u, &beside);
    chain->x += beside;
  }

 private:
  static double gain(const DataSummary& data) {
    return 0.05 * data.output_deviation / data.input_deviation;
  }

  double sample_time_;
};

const EffectRegistration kRegistration(10, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<PlantResonance>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
