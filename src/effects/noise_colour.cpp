#include <cmath>

#include "math/polynomial.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// White, and pairs of poles over the frequencies: from the declared poles alone the optimisation
/// may end where these have taken the place of those that are missing.
std::vector<VectorXd> starts() {
  constexpr double kRadius = 0.7;
  std::vector<VectorXd> all{VectorXd::Zero(2)};
  for (const double frequency : {0.5, 1.0, 1.6, 2.1, 2.6}) {
    all.emplace_back(2);
    all.back() << -2 * kRadius * std::cos(frequency), kRadius * kRadius;
  }
  return all;
}

/// D (1 + d1 q^-1 + d2 q^-2).
class NoiseColour : public Effect {
 public:
  NoiseColour()
      : Effect(
            {"noise_colour",
             "",
             "disturbance that is coloured other than the noise model says",
             "Raise the order of the noise model (nc, nd), or look for the disturbance's source.",
             {},
             Stage::measurement,
             ScreeningKind::regression,
             {{"d1", "1", 0.2}, {"d2", "1", 0.2}},
             starts()}) {}

  bool admissible(const VectorXd& psi) const override { return isStable(psi, 0.999); }

  void apply(const VectorXd& psi, Chain* chain) const override {
    chain->noise_d = multiply(chain->noise_d, psi);
  }
};

const EffectRegistration kRegistration(20, [](const DataSummary&) -> MadeEffects {
  return {std::make_shared<NoiseColour>()};
});
}  // namespace
}  // namespace uncertainty_identification
