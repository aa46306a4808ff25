#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// Gain 1 + slope (T - mean T)/10 for a covariate T.
class PlantTemperature : public Effect {
 public:
  PlantTemperature(const std::string& covariate, double mean)
      : Effect({"plant_temp",
                covariate,
                "gain of the plant that depends on " + covariate,
                "Record " + covariate + " with every experiment, or hold it constant.",
                {},
                Stage::actuator,
                ScreeningKind::regression,
                {{"slope", "relative gain per 10 units of " + covariate, 0.1}},
                {VectorXd::Zero(1)}}),
        covariate_(covariate),
        mean_(mean) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    chain->u *= 1 + psi[0] * (chain->covariate(covariate_) - mean_) / 10;
  }

 private:
  std::string covariate_;
  double mean_;
};

const EffectRegistration kRegistration(110, [](const DataSummary& data) -> MadeEffects {
  MadeEffects all;
  for (const auto& [name, mean] : data.covariates)
    all.push_back(std::make_shared<PlantTemperature>(name, mean));
  return all;
});
}  // namespace
}  // namespace uncertainty_identification
