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
    constexpr double kStep = 1e-5;
    VectorXd theta = chain->theta;
    const double change = kStep * std::max(std::abs(theta[index_]), 1e-300);
    theta[index_] += change;
    const Polynomials at = chain->nominal.polynomials(chain->theta);
    const Polynomials moved = chain->nominal.polynomials(theta);
    Signals before, after;
    filter(at.b, at.a, at.delay, chain->u, &before);
    filter(moved.b, moved.a, moved.delay, chain->u, &after);
    chain->random.push_back({(after - before) / kStep, std::exp(psi[0])});
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
