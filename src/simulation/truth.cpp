#include "simulation/truth.h"

#include <algorithm>
#include <cmath>

#include "configuration/require.h"
#include "math/polynomial.h"
#include "model/sensitivity.h"
#include "simulation/spread_plant.h"
#include "uncertainty_identification/model/error_basis.h"

namespace uncertainty_identification {
namespace {

constexpr double kOnTheCircle = 1 + 1e-9;  // an integrator has a pole at 1 and is allowed

/// Throws unless all roots of the polynomial, given without its leading 1, lie within the radius.
void requireRoots(const std::string& key, const Eigen::VectorXd& monic, double radius) {
  require(monic.size() == 0 || isStable(monic, radius), key, "roots outside the unit circle",
          radius > 1 ? "roots inside or on it" : "roots inside it");
}

/// Checks the effects against the rest of the truth.
void validateTogether(const Truth& truth) {
  const PlantEffects& plant = truth.effects.plant;
  require(!truth.effects.feedsBack() || truth.plant.delay >= 1, "plant.delay", truth.plant.delay,
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

int Truth::samplesOf(int r) const {
  return samples.size() == 1 ? samples.front() : samples[static_cast<std::size_t>(r)];
}

void Truth::validate() const {
  range::kPositive.check("sample_time", sample_time);
  requireRange("experiments.count", experiments, 1, 100000000);
  require(samples.size() == 1 || samples.size() == static_cast<std::size_t>(experiments),
          "experiments.samples", std::to_string(samples.size()) + " numbers",
          "one for all, or one for each of the experiments");
  for (const int count : samples) requireRange("experiments.samples", count, 1, 1000000000);
  const int shortest = *std::min_element(samples.begin(), samples.end());
  require(
      input.kind != InputKind::multisine || 2 * input.tones < shortest, "input.tones", input.tones,
      "fewer than half the " + std::to_string(shortest) + " samples of the shortest experiment");
  checkFields("input", input);
  checkFields("plant", plant);
  require(plant.b.size() >= 1, "plant.b", "no number", "at least one");
  requireRoots("plant.a", plant.a, kOnTheCircle);
  error_model.validate();
  checkFields("sensor", sensor);
  checkFields("noise", noise);
  requireRoots("noise.d", noise.d, noise.start == NoiseStart::stationary ? 1 - 1e-9 : kOnTheCircle);
  effects.validate();
  validateTogether(*this);
}

}  // namespace uncertainty_identification
