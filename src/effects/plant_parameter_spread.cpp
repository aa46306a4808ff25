#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"
#include "uncertainty_identification/model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// A parameter of Go varies from experiment to experiment: to first order dGo/dtheta_j u times a
/// random relative deviation.
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
             values({-6, -3, 0, 3, 6})}),
        index_(index) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    // central: of second order in the step
    constexpr double kStep = 1e-5;
    const double change = kStep * std::max(std::abs(chain->theta[index_]), 1e-300);
    const Signals difference = output(*chain, change) - output(*chain, -change);
    chain->random.push_back({difference / (2 * kStep), std::exp(psi[0])});
  }

 private:
  Signals output(const Chain& chain, double change) const {
    VectorXd theta = chain.theta;
    theta[index_] += change;
    const Polynomials moved = chain.nominal.polynomials(theta);
    Signals y;
    filter(moved.b, moved.a, moved.delay, chain.u, &y);
    return y;
  }

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
