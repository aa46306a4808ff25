#include <cmath>
#include <random>

#include "math/constants.h"
#include "math/random_stream.h"
#include "math/symmetric_eigen.h"
#include "simulation/simulate.h"
#include "simulation/spread_plant.h"

namespace uncertainty_identification {
namespace {

/// Draws xi from the mixture; `component` receives the number of the component that it came from.
Eigen::VectorXd drawFrom(const Mixture& mixture, std::mt19937_64& random,
                         std::optional<int>* component) {
  std::discrete_distribution<int> pick(mixture.weights.begin(), mixture.weights.end());
  *component = pick(random);
  const auto i = static_cast<std::size_t>(**component);
  // Unlike a Cholesky factor, this square root also exists for a singular covariance.
  const SymmetricEigen eigen(mixture.covariances[i]);
  const Eigen::VectorXd scale = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  return mixture.means[i] +
         eigen.eigenvectors() * scale.cwiseProduct(gaussian(mixture.dimension(), 1, random));
}

double drawTimeConstant(const PlantTruth& plant, std::mt19937_64& random) {
  std::uniform_real_distribution<double> relative(-plant.time_constant_spread,
                                                  plant.time_constant_spread);
  return plant.time_constant * (1 + relative(random));
}

/// The position of experiment r in the sequence: -1/2 for the first and 1/2 for the last.
double position(const Truth& truth, int r) {
  return truth.experiments > 1 ? static_cast<double>(r) / (truth.experiments - 1) - 0.5 : 0;
}

/// Applies exp_mode, which may replace the xi that the mixture drew, and then plant_aging, which
/// shifts it.
void changeError(const Truth& truth, std::uint64_t seed, int r, DrawnSystem* system) {
  if (const auto& mode = truth.effects.experiment.mode) {
    std::mt19937_64 random = randomStream(seed, r, RandomPurpose::mode);
    const double chance = std::uniform_real_distribution<double>()(random);
    const Eigen::VectorXd standard = gaussian(truth.error_model.mixture.dimension(), 1, random);
    if (chance < mode->weight) {
      system->component = truth.error_model.mixture.components();
      system->xi = mode->mean + mode->deviation * standard;
    }
  }
  if (const auto& aging = truth.effects.plant.aging)
    system->xi += position(truth, r) * aging->shift;
}

/// Draws the random numbers of all effects, present or not, so that adding one effect to a truth
/// does not change the numbers of another.
void drawEffects(const EffectsTruth& effects, std::mt19937_64 random, EffectDraws* draws) {
  std::normal_distribution<double> standard;
  const double initial_state = standard(random), bias = standard(random), drift = standard(random),
               clock = standard(random);
  const double phase = std::uniform_real_distribution<double>(-kPi, kPi)(random);
  if (const auto& init = effects.plant.init) draws->initial_state = init->deviation * initial_state;
  if (const auto& sensor = effects.sensor.bias; sensor && sensor->per_experiment)
    draws->bias = sensor->deviation * bias;
  if (const auto& sensor = effects.sensor.drift; sensor && sensor->per_experiment)
    draws->drift = sensor->deviation * drift;
  if (const auto& hum = effects.sensor.hum; hum && hum->per_experiment) draws->hum_phase = phase;
  if (const auto& shift = effects.experiment.clock) draws->clock_shift = shift->deviation * clock;
}

}  // namespace

DrawnSystem drawSystem(const Truth& truth, std::uint64_t seed, int r) {
  std::mt19937_64 random = randomStream(seed, r, RandomPurpose::system);
  const bool first_order = truth.plant.structure == PlantStructure::first_order;
  DrawnSystem system;
  PlantTruth plant = truth.plant;
  if (first_order) plant.time_constant = drawTimeConstant(truth.plant, random);
  const Mixture& mixture = truth.error_model.mixture;
  if (mixture.components() > 0) system.xi = drawFrom(mixture, random, &system.component);
  if (const auto& spread = truth.effects.plant.parameter_spread) {
    std::mt19937_64 spread_random = randomStream(seed, r, RandomPurpose::parameter_spread);
    plant = spreadPlant(plant, *spread, spread_random, &system.effects.parameter_deviation);
  }
  system.polynomials = plantPolynomials(plant, truth.sample_time);
  if (first_order) system.time_constant = plant.time_constant;
  system.polynomials.c = truth.noise.c;
  system.polynomials.d = truth.noise.d;
  changeError(truth, seed, r, &system);
  drawEffects(truth.effects, randomStream(seed, r, RandomPurpose::effects), &system.effects);
  return system;
}

}  // namespace uncertainty_identification
