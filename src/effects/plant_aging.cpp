#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// The means of the error parameters move with the position of the experiment in the series.
class PlantAging : public Effect {
 public:
  explicit PlantAging(const DataSummary& data)
      : Effect({"plant_aging",
                "",
                "plant that changes from experiment to experiment",
                "Repeat one of the first experiments now; look for wear, fouling or a battery.",
                {},
                Stage::output,
                ScreeningKind::regression,
                shifts(data.regressors),
                {VectorXd::Zero(data.regressors)}}),
        starts_(data.starts) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const Lanes positions = chain->positions(starts_);
    for (Eigen::Index i = 0; i < psi.size(); ++i)
      chain->x += chain->X[static_cast<std::size_t>(i)].colwise() * (psi[i] * positions);
  }

 private:
  static std::vector<EffectParameter> shifts(int count) {
    std::vector<EffectParameter> all;
    for (int i = 1; i <= count; ++i)
      all.push_back({"shift" + std::to_string(i), "1, first to last experiment", 0.3});
    return all;
  }

  VectorXd starts_;
};

const EffectRegistration kRegistration(30, [](const DataSummary& data) -> MadeEffects {
  if (data.regressors == 0 || data.experiments < 5) return {};
  return {std::make_shared<PlantAging>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
