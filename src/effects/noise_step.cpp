#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::vector<VectorXd> starts(const DataSummary& data) {
  std::vector<VectorXd> all;
  for (const double ratio : {std::exp(0.5), std::exp(-0.5)}) {
    for (int k = 1; k < 10; ++k) {
      VectorXd start(2);
      start << ratio, 0.1 * k * data.samples * data.sample_time;
      all.push_back(start);
    }
  }
  return all;
}

/// The innovations' standard deviation changes by a ratio at a time within each experiment.
class NoiseStep : public Effect {
 public:
  explicit NoiseStep(const DataSummary& data)
      : Effect({"noise_step",
                "",
                "noise that becomes stronger or weaker during each experiment",
                "Look for what is switched on or off at the time named.",
                {},
                Stage::noise,
                ScreeningKind::likelihood,
                {{"ratio", "1", 0.3, 0.02, 50.0},
                 {"time", "s", 0.1 * data.samples * data.sample_time, 0.0,
                  data.samples * data.sample_time, false}},
                starts(data)}),
        sample_time_(data.sample_time) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const auto on = (chain->time() - psi[1] / sample_time_ + 1).max(0.0).min(1.0).eval();
    chain->scaleDeviation(Signals::Ones(kLanes, on.cols()).rowwise() *
                          ((on - 0.5) * std::log(psi[0])).exp());
  }

 private:
  double sample_time_;
};

const EffectRegistration kRegistration(20, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<NoiseStep>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
