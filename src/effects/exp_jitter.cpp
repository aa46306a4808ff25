#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// Output taken at its stamped instants instead of on the grid, as far as `share` says.
class SamplingJitter : public Effect {
 public:
  explicit SamplingJitter(double sample_time)
      : Effect({"exp_jitter",
                "",
                "output sampled at the stamped instants, off the grid",
                "Sample on a timer, or resample by the stamps (resampling.output: linear).",
                {},
                Stage::output,
                ScreeningKind::regression,
                {{"share", "1", 0.5, -1.0, 3.0}},
                values({0.5, 1})}),
        sample_time_(sample_time) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    Signals shift = Signals::Zero(kLanes, chain->x.cols());
    for (int lane = 0; lane < chain->block.lanes; ++lane) {
      const VectorXd& offset =
          chain->block.experiments[static_cast<std::size_t>(lane)]->stamp_offset;
      shift.row(lane).head(offset.size()) = psi[0] / sample_time_ * offset.transpose().array();
    }
    chain->x = interpolated(chain->x, shift);
    for (Signals& regressor : chain->X) regressor = interpolated(regressor, shift);
  }

 private:
  double sample_time_;
};

const EffectRegistration kRegistration(70, [](const DataSummary& data) -> MadeEffects {
  if (!data.stamps) return {};
  return {std::make_shared<SamplingJitter>(data.sample_time)};
});
}  // namespace
}  // namespace uncertainty_identification
