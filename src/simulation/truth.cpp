#include "uncertainty_identification/simulation/truth.h"

#include <algorithm>
#include <cmath>

#include "uncertainty_identification/model/error_basis.h"
#include "uncertainty_identification/model/polynomial.h"
#include "uncertainty_identification/model/sensitivity.h"
#include "uncertainty_identification/require.h"

namespace uncertainty_identification {
namespace {

constexpr double kOnTheCircle = 1 + 1e-9;  // an integrator is a plant too

void requirePolynomial(const std::string& key, const Eigen::VectorXd& monic, double radius) {
  require(monic.allFinite(), key, "an entry that is not finite", "finite numbers");
  require(monic.size() == 0 || isStable(monic, radius), key, "roots outside the unit circle",
          radius > 1 ? "roots inside or on it" : "roots inside it");
}

void requireFinite(const std::string& key, double value) {
  require(std::isfinite(value), key, value, "a finite number");
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
  require(variance >= 0 && std::isfinite(variance), "input.variance", variance,
          "a finite number, 0 or above");
  requireRange("input.hold", hold, 1, 1000000);
  requireRange("input.tones", tones, 1, 1000000);
}

void PlantTruth::validate() const {
  require(b.size() >= 1 && b.allFinite(), "plant.b", b.transpose(), "at least one finite number");
  requirePolynomial("plant.a", a, kOnTheCircle);
  requireRange("plant.delay", delay, 0, 100000);
  requireFinite("plant.gain", gain);
  require(time_constant > 0 && std::isfinite(time_constant), "plant.time_constant", time_constant,
          "a finite number above 0");
  require(time_constant_spread >= 0 && time_constant_spread < 1, "plant.time_constant_spread",
          time_constant_spread, "at least 0 and below 1");
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

void SensorTruth::validate() const {
  require(missing >= 0 && missing < 1, "sensor.missing", missing, "at least 0 and below 1");
}

void NoiseTruth::validate() const {
  require(variance >= 0 && std::isfinite(variance), "noise.variance", variance,
          "a finite number, 0 or above");
  require(c.allFinite(), "noise.c", "an entry that is not finite", "finite numbers");
  requirePolynomial("noise.d", d, start == NoiseStart::stationary ? 1 - 1e-9 : kOnTheCircle);
}

int Truth::samplesOf(int r) const {
  return samples.size() == 1 ? samples.front() : samples[static_cast<std::size_t>(r)];
}

void Truth::validate() const {
  require(sample_time > 0 && std::isfinite(sample_time), "sample_time", sample_time,
          "a finite number above 0");
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
}

}  // namespace uncertainty_identification
