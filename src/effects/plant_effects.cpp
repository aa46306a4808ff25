#include <algorithm>
#include <cmath>

#include "effects/built_in_effects.h"
#include "effects/effect_functions.h"
#include "model/filter.h"

/// What may make the plant differ from its linear model: a gain that is not constant, feedback
/// inside the plant, dynamics that the model lacks, and an initial state.
namespace uncertainty_identification {

using Eigen::VectorXd;

/// The gain is 1 + slope (t/N - 1/2) over each experiment of N samples.
MadeEffects plantDrift(const DataSummary& /*data*/) {
  return {chainEffect({"plant_drift",
                       "",
                       "gain of the plant that drifts during each experiment",
                       "Look for what warms up, wears or empties within one experiment.",
                       {},
                       Stage::actuator,
                       ScreeningKind::regression,
                       {{"slope", "relative gain per experiment", 0.3, -1.9, 1.9}},
                       {VectorXd::Zero(1)}},
                      [](const VectorXd& psi, Chain* chain) {
                        chain->u *= 1 + psi[0] * (chain->relativeTime() - 0.5);
                      })};
}

/// The gain is 1 + slope (T - mean T)/10 for a covariate T; one effect for each covariate.
MadeEffects plantTemperature(const DataSummary& data) {
  MadeEffects all;
  for (const auto& [name, mean_of] : data.covariates) {
    all.push_back(
        chainEffect({"plant_temp",
                     name,
                     "gain of the plant that depends on " + name,
                     "Record " + name + " with every experiment, or hold it constant.",
                     {},
                     Stage::actuator,
                     ScreeningKind::regression,
                     {{"slope", "relative gain per 10 units of " + name, 0.1}},
                     {VectorXd::Zero(1)}},
                    [covariate = name, mean = mean_of](const VectorXd& psi, Chain* chain) {
                      chain->u *= 1 + psi[0] * (chain->covariate(covariate) - mean) / 10;
                    }));
  }
  return all;
}

/// The plant's input is u - stiffness x^3, x its output: a spring that hardens or softens. Far
/// beyond the measured outputs the force stays constant, so that a simulation cannot diverge.
MadeEffects plantCubicStiffness(const DataSummary& data) {
  const double unit = data.input_deviation * std::pow(data.output_deviation, -3);
  return {loopEffect({"plant_cubic",
                      "",
                      "stiffness of the plant that depends on its deflection",
                      "Repeat an experiment at half and at twice the amplitude.",
                      {},
                      Stage::loop,
                      ScreeningKind::regression,
                      {{"stiffness", "unit of u per cubed unit of y", unit}},
                      values({0.02, 0.15, -0.02}, unit),
                      /*nonlinear=*/true},
                     [largest = 8 * data.output_deviation](const VectorXd& psi, const Lanes& x,
                                                           const Lanes& /*before*/) -> Lanes {
                       return psi[0] * x.min(largest).max(-largest).cube();
                     })};
}

/// The plant's input is u - friction tanh(v/width), v the change of the output per sample. A
/// friction beyond the largest input would hold the plant at rest, and is a damping.
MadeEffects plantCoulombFriction(const DataSummary& data) {
  const double largest = data.input_sizes.size() > 0 ? data.input_sizes.maxCoeff() : 0;
  std::vector<VectorXd> starts;
  for (const double width : {0.05, 0.3})
    starts.push_back(Eigen::Vector2d(0.1 * data.input_deviation, width * data.output_deviation));
  return {loopEffect(
      {"plant_coulomb",
       "",
       "Coulomb friction in the plant",
       "Move slowly in both directions: the force needed does not vanish with the speed.",
       {},
       Stage::loop,
       ScreeningKind::regression,
       {{"friction", "unit of u", 0.1 * data.input_deviation, 0,
         std::max(largest, 2 * data.input_deviation)},
        {"width", "unit of y per sample", 0.1 * data.output_deviation,
         0.005 * data.output_deviation, 10 * data.output_deviation}},
       starts,
       /*nonlinear=*/true},
      [](const VectorXd& psi, const Lanes& x, const Lanes& before) -> Lanes {
        return psi[0] * (1 - 2 / ((2 / psi[1] * (x - before)).min(60.0).exp() + 1));
      })};
}

/// In parallel to Go: (g1 q^-1 + g2 q^-2)/(1 - 2 radius cos(w) q^-1 + radius^2 q^-2), w the
/// frequency in radians per sample. The starts scan the frequencies.
MadeEffects plantResonance(const DataSummary& data) {
  constexpr int kStarts = 30;
  std::vector<VectorXd> starts;
  starts.reserve(kStarts);
  for (int k = 0; k < kStarts; ++k)
    starts.push_back(
        Eigen::Vector4d(0.95, (0.1 + 2.9 * k / (kStarts - 1.0)) / data.sample_time, 0, 0));
  const double gain = 0.05 * data.output_deviation / data.input_deviation;
  return {chainEffect({"plant_resonance",
                       "",
                       "resonance of the plant that the model lacks",
                       "Excite the plant at the estimated frequency and see what vibrates.",
                       {},
                       Stage::plant,
                       ScreeningKind::regression,
                       {{"radius", "1", 0.05, 0.3, 0.9985},
                        {"frequency", "rad/s", 0.1 / data.sample_time, 0.01 / data.sample_time,
                         3.14 / data.sample_time},
                        {"g1", "unit of y per unit of u", gain},
                        {"g2", "unit of y per unit of u", gain}},
                       starts,
                       /*nonlinear=*/false,
                       /*own_point=*/false,
                       {Trait::order}},
                      [sample_time = data.sample_time](const VectorXd& psi, Chain* chain) {
                        VectorXd numerator = VectorXd::Zero(3), denominator(2);
                        numerator.tail(2) = psi.tail(2);
                        denominator << -2 * psi[0] * std::cos(psi[1] * sample_time),
                            psi[0] * psi[0];
                        Signals parallel;
                        filter(numerator, denominator, 0, chain->u, &parallel);
                        chain->x += parallel;
                      })};
}

/// An extra lag in series with the plant: (1 - pole)/(1 - pole q^-1).
MadeEffects plantPole(const DataSummary& /*data*/) {
  return {
      chainEffect({"plant_pole",
                   "",
                   "lag of the plant that the model lacks",
                   "Raise the order of the model by one, or look for a slow actuator or filter.",
                   {"sens_lag", "act_delay"},
                   Stage::plant,
                   ScreeningKind::regression,
                   {{"pole", "1", 0.2, -0.9, 0.99}},
                   values({0.15, 0.5, 0.8}),
                   /*nonlinear=*/false,
                   /*own_point=*/false,
                   {Trait::order, Trait::moves_plant}},
                  [](const VectorXd& psi, Chain* chain) {
                    chain->filterOutput(VectorXd::Constant(1, 1 - psi[0]), -psi);
                  })};
}

/// The means of the error parameters move in proportion to the position of the experiment in the
/// series.
MadeEffects plantAging(const DataSummary& data) {
  if (data.regressors == 0 || data.experiments < 5) return {};
  std::vector<EffectParameter> shifts;
  for (int i = 1; i <= data.regressors; ++i)
    shifts.push_back({"shift" + std::to_string(i), "1, first to last experiment", 0.3});
  return {chainEffect(
      {"plant_aging",
       "",
       "plant that changes from experiment to experiment",
       "Repeat one of the first experiments now; look for wear, fouling or a battery.",
       {},
       Stage::output,
       ScreeningKind::regression,
       shifts,
       {VectorXd::Zero(data.regressors)},
       /*nonlinear=*/false,
       /*own_point=*/false,
       {Trait::of_mixture},
       /*excludes=*/{},
       /*least_score=*/4.5},
      [starts = data.starts](const VectorXd& psi, Chain* chain) {
        const Lanes positions = chain->positions(starts);
        for (Eigen::Index i = 0; i < psi.size(); ++i)
          chain->x += chain->X[static_cast<std::size_t>(i)].colwise() * (psi[i] * positions);
      })};
}

/// x + c_r times the impulse response of 1/A, c_r random in each experiment.
MadeEffects plantInitialState(const DataSummary& /*data*/) {
  return {chainEffect(
      {"plant_init",
       "",
       "plant that is not at rest when an experiment begins",
       "Wait longer before an experiment, or set estimation.initial_state: estimate.",
       {},
       Stage::output,
       ScreeningKind::likelihood,
       {logVariance("deviation", "unit of y")},
       values({-2, 1, 4, 8})},
      [](const VectorXd& psi, Chain* chain) {
        Signals impulse = Signals::Zero(kLanes, chain->x.cols()), z;
        impulse.col(0).setOnes();
        filter(VectorXd::Ones(1), chain->nominal.polynomials(chain->theta).a, 0, impulse, &z);
        chain->random.push_back({z, std::exp(psi[0])});
      })};
}

}  // namespace uncertainty_identification
