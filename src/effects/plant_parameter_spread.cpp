#include <cmath>

#include "model/filter.h"
#include "model/plant_derivatives.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// A parameter of Go varies from experiment to experiment: theta_j (1 + c_r), c_r random.
class PlantParameterSpread : public Effect {
 public:
  PlantParameterSpread(const std::string& parameter, int index)
      : Effect(
            {"plant_parameter_spread",
             parameter,
             parameter + " varies from experiment to experiment, beyond what the error model holds",
             "Identify with error_model: {basis: parameter_spread, parameters: [" + parameter +
                 "]}.",
             {},
             Stage::output,
             ScreeningKind::likelihood,
             {logVariance("deviation", "relative")},
             values({-6, -3, 0, 3, 6}),
             true,
             true}),
        index_(index) {}

  /// Linearised about the parameter's own values t_r, as basis: parameter_spread does:
  ///   x + (Go(t_r) - Go) u + (theta_j (1 + c_r) - t_r) dGo/dtheta_j(t_r) u.
  void apply(const VectorXd& psi, Chain* chain) const override {
    const double common = chain->theta[index_];
    const Lanes own = chain->ownPoint();
    const bool apart = (own != common).any();
    std::vector<PlantCoefficients> plants;
    VectorXd theta = chain->theta;
    for (int lane = 0; lane < (apart ? chain->block.lanes : 1); ++lane) {
      theta[index_] = own[lane];
      plants.emplace_back(chain->nominal, theta);
    }
    PlantDerivatives plant(&plants, chain->u);
    RandomSignal spread{common * plant.signal({index_}), std::exp(psi[0]), Lanes::Zero(),
                        chain->own_point};
    if (apart) {
      const Polynomials go = chain->nominal.polynomials(chain->theta);
      Signals usual;
      filter(go.b, go.a, go.delay, chain->u, &usual);
      spread.about = own / common - 1;
      chain->x += plant.signal({}) - usual - spread.z.colwise() * spread.about;
    }
    chain->random.push_back(std::move(spread));
  }

  /// The parameter's own value; less far off where the plant would not be admissible.
  double pointAt(double size, const NominalModel& nominal, const VectorXd& theta) const override {
    constexpr int kHalvings = 10;
    VectorXd own = theta;
    for (int k = 0; k < kHalvings; ++k, size /= 2) {
      own[index_] = theta[index_] * (1 + size);
      if (nominal.admissible(own)) return own[index_];
    }
    return theta[index_];
  }

 private:
  int index_;
};

const EffectRegistration kRegistration(50, [](const DataSummary& data) -> MadeEffects {
  MadeEffects all;
  for (const std::string& parameter : data.plant_parameters)
    all.push_back(std::make_shared<PlantParameterSpread>(parameter, static_cast<int>(all.size())));
  return all;
});
}  // namespace
}  // namespace uncertainty_identification
