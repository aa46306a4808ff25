#include <algorithm>
#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// Output taken tau_r later in each experiment, tau_r random: about the shift known so far, the
/// rest as a random multiple of dx/dt.
class ClockOffset : public Effect {
 public:
  ClockOffset()
      : Effect({"exp_clock",
                "",
                "clocks of input and output that differ by experiment",
                "Stamp command and measurement by one clock, or send a common trigger.",
                {},
                Stage::output,
                ScreeningKind::likelihood,
                {logVariance("deviation", "samples")},
                values({0, 3, 6}),
                true,
                true}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    constexpr double kStep = 0.05;
    const Signals expected = chain->expected();
    const Lanes shift = chain->ownPoint();
    const Signals slope = (interpolated(expected, Lanes(shift + kStep)) -
                           interpolated(expected, Lanes(shift - kStep))) /
                          (2 * kStep);
    chain->x = interpolated(chain->x, shift) - slope.colwise() * shift;
    for (Signals& regressor : chain->X) regressor = interpolated(regressor, shift);
    for (RandomSignal& signal : chain->random) signal.z = interpolated(signal.z, shift);
    chain->random.push_back({slope, std::exp(psi[0]), chain->ownPoint(), chain->own_point});
  }

  double pointAt(double size, const NominalModel& /*nominal*/,
                 const VectorXd& /*theta*/) const override {
    constexpr double kLargest = 8;  // [samples] that a linearisation can follow
    return std::clamp(size, -kLargest, kLargest);
  }
};

const EffectRegistration kRegistration(80, [](const DataSummary&) -> MadeEffects {
  return {std::make_shared<ClockOffset>()};
});
}  // namespace
}  // namespace uncertainty_identification
