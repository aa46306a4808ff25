#include <cmath>

#include "model/filter.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::vector<VectorXd> starts(const DataSummary& data) {
  std::vector<VectorXd> all;
  for (const double pole : {0.1, 0.6, 0.9}) {
    VectorXd start(2);
    start << 0.2 * data.output_deviation, pole;
    all.push_back(start);
  }
  return all;
}

/// x + gain (1 - pole) q^-1/(1 - pole q^-1) d for a covariate d.
class SecondInput : public Effect {
 public:
  SecondInput(const DataSummary& data, const std::string& covariate)
      : Effect({"exp_input2",
                covariate,
                covariate + " drives the output too",
                "Take " + covariate + " into the model as an input, or keep it constant.",
                {},
                Stage::output,
                ScreeningKind::regression,
                {{"gain", "unit of y per unit of " + covariate, data.output_deviation},
                 {"pole", "1", 0.2, -0.95, 0.995}},
                starts(data)}),
        covariate_(covariate) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    Signals response;
    VectorXd numerator = VectorXd::Zero(2);
    numerator[1] = psi[0] * (1 - psi[1]);
    filter(numerator, VectorXd::Constant(1, -psi[1]), 0, chain->covariate(covariate_), &response);
    chain->x += response;
  }

 private:
  std::string covariate_;
};

const EffectRegistration kRegistration(60, [](const DataSummary& data) -> MadeEffects {
  MadeEffects all;
  for (const auto& [name, mean] : data.covariates)
    all.push_back(std::make_shared<SecondInput>(data, name));
  return all;
});
}  // namespace
}  // namespace uncertainty_identification
