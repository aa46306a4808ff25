#include "simulation/truth.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"
#include "model/sensitivity.h"
#include "simulation/require_number.h"
#include "simulation/spread_plant.h"
#include "uncertainty_identification/model/error_basis.h"

namespace uncertainty_identification {
namespace {

constexpr double kOnTheCircle = 1 + 1e-9;  // an integrator is a plant too

void requirePolynomial(const std::string& key, const Eigen::VectorXd& monic, double radius) {
  require(monic.allFinite(), key, "an entry that is not finite", "finite numbers");
  require(monic.size() == 0 || isStable(monic, radius), key, "roots outside the unit circle",
          radius > 1 ? "roots inside or on it" : "roots inside it");
}

/// What effects need of the rest of the truth.
void validateNeeds(const Truth& truth) {
  const PlantEffects& plant = truth.effects.plant;
  const UnnamedEffects& unnamed = truth.effects.unnamed;
  const bool loop =
      plant.cubic || plant.coulomb || unnamed.bilinear || unnamed.gravity || unnamed.outflow;
  require(!loop || truth.plant.delay >= 1, "plant.delay", truth.plant.delay,
          "1 or above with an effect that feeds the output back within the plant");
  const auto requireDimension = [&](const std::string& key, const Eigen::VectorXd& value) {
    const int dimension = truth.error_model.mixture.dimension();
    require(dimension > 0 && value.size() == dimension, key,
            std::to_string(value.size()) + " numbers",
            dimension > 0 ? std::to_string(dimension) + ", one for each free error parameter"
                          : "the effect only with an error_model that has components");
  };
  if (plant.aging) requireDimension("effects.plant_aging.shift", plant.aging->shift);
  if (truth.effects.experiment.mode)
    requireDimension("effects.exp_mode.mean", truth.effects.experiment.mode->mean);
  if (plant.parameter_spread) requireParameter(truth.plant, plant.parameter_spread->parameter);
}

}  // namespace

const EnumNames<InputKind>& enumNames(InputKind) {
  static const EnumNames<InputKind> kNames{{InputKind::white_noise, "white_noise"},
                                           {InputKind::prbs, "prbs"},
                                           {InputKind::steps, "steps"},
                                           {InputKind::multisine, "multisine"}};
  return kNames;
}

const EnumNames<PlantStructure>& enumNames(PlantStructure) {
  static const EnumNames<PlantStructure> kNames{{PlantStructure::polynomials, "polynomials"},
                                                {PlantStructure::first_order, "first_order"}};
  return kNames;
}

void InputTruth::validate() const {
  requireFinite("input.mean", mean);
  requireNotNegative("input.variance", variance);
  requireRange("input.hold", hold, 1, 1000000);
  requireRange("input.tones", tones, 1, 1000000);
  requireProbability("input.amplitude_spread", amplitude_spread);
}

void PlantTruth::validate() const {
  require(b.size() >= 1 && b.allFinite(), "plant.b", b.transpose(), "at least one finite number");
  requirePolynomial("plant.a", a, kOnTheCircle);
  requireRange("plant.delay", delay, 0, 100000);
  requireFinite("plant.gain", gain);
  requirePositive("plant.time_constant", time_constant);
  requireProbability("plant.time_constant_spread", time_constant_spread);
}

void ErrorModelTruth::validate() const {
  if (mixture.components() == 0) return;
  require(basis.taps != kAutomatic, "error_model.taps", "auto", "a number");
  require(!variesParameters(basis.basis), "error_model.basis", nameOf(basis.basis),
          "fir, laguerre or kautz; a parameter that varies is plant.time_constant_spread");
  basis.validate();
  mixture.validate("error_model");
  const int free = ErrorBasis(basis).dimension();
  require(mixture.dimension() == free, "error_model.means",
          "vectors of " + std::to_string(mixture.dimension()),
          "vectors of " + std::to_string(free) +
              ", the free error parameters of these taps and constraint");
}

void SensorTruth::validate() const { requireProbability("sensor.missing", missing); }

void NoiseTruth::validate() const {
  requireNotNegative("noise.variance", variance);
  require(c.allFinite(), "noise.c", "an entry that is not finite", "finite numbers");
  requirePolynomial("noise.d", d, start == NoiseStart::stationary ? 1 - 1e-9 : kOnTheCircle);
}

int Truth::samplesOf(int r) const {
  return samples.size() == 1 ? samples.front() : samples[static_cast<std::size_t>(r)];
}

void Truth::validate() const {
  requirePositive("sample_time", sample_time);
  requireRange("experiments.count", experiments, 1, 100000000);
  require(samples.size() == 1 || samples.size() == static_cast<std::size_t>(experiments),
          "experiments.samples", std::to_string(samples.size()) + " numbers",
          "one for all, or one for each of the experiments");
  for (const int count : samples) requireRange("experiments.samples", count, 1, 1000000000);
  const int shortest = *std::min_element(samples.begin(), samples.end());
  require(
      input.kind != InputKind::multisine || 2 * input.tones < shortest, "input.tones", input.tones,
      "fewer than half the " + std::to_string(shortest) + " samples of the shortest experiment");
  input.validate();
  plant.validate();
  error_model.validate();
  sensor.validate();
  noise.validate();
  effects.validate();
  validateNeeds(*this);
}

}  // namespace uncertainty_identification
