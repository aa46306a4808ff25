#include "simulation/spread_plant.h"

#include <cmath>
#include <cstdlib>

#include "configuration/require.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

/// The coefficient that a name such as b1 or a2 stands for; null when the polynomial has none.
double* coefficient(Eigen::VectorXd& polynomial, const std::string& name) {
  const int number = std::atoi(name.c_str() + 1);
  const bool known =
      number >= 1 && number <= polynomial.size() && name.substr(1) == std::to_string(number);
  return known ? &polynomial(number - 1) : nullptr;
}

/// The parameter of Go with this name; null when there is none.
double* parameterOf(PlantTruth& plant, const std::string& name) {
  if (plant.structure == PlantStructure::first_order) {
    if (name == "gain") return &plant.gain;
    return name == "time_constant" ? &plant.time_constant : nullptr;
  }
  if (name.rfind('b', 0) == 0) return coefficient(plant.b, name);
  return name.rfind('a', 0) == 0 ? coefficient(plant.a, name) : nullptr;
}

bool stable(const PlantTruth& plant) {
  return plant.structure == PlantStructure::first_order ? plant.time_constant > 0
                                                        : isStable(plant.a);
}

}  // namespace

void requireParameter(const PlantTruth& plant, const std::string& name) {
  PlantTruth copy = plant;
  const double* parameter = parameterOf(copy, name);
  require(parameter != nullptr && *parameter != 0, "effects.plant_parameter_spread.parameter", name,
          plant.structure == PlantStructure::first_order
              ? "gain or time_constant"
              : "one of the plant's b1.. and a1.. that is not 0");
}

// A first-order plant is gain/(1 + tau s) under zero-order hold, equation (39).
Polynomials plantPolynomials(const PlantTruth& plant, double sample_time) {
  Polynomials polynomials;
  polynomials.delay = plant.delay;
  polynomials.b = plant.b;
  polynomials.a = plant.a;
  if (plant.structure == PlantStructure::first_order) {
    const double pole = std::exp(-sample_time / plant.time_constant);
    polynomials.b = Eigen::VectorXd::Constant(1, plant.gain * (1 - pole));
    polynomials.a = Eigen::VectorXd::Constant(1, -pole);
  }
  return polynomials;
}

PlantTruth spreadPlant(const PlantTruth& plant, const ParameterSpreadTruth& spread,
                       std::mt19937_64& random, double* deviation) {
  std::normal_distribution<double> standard;
  constexpr int kAttempts = 1000;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    PlantTruth varied = plant;
    *deviation = spread.deviation * standard(random);
    *parameterOf(varied, spread.parameter) *= 1 + *deviation;
    if (stable(varied)) return varied;
  }
  throw ConfigurationError("effects.plant_parameter_spread.deviation: found " +
                           std::to_string(spread.deviation) +
                           ", with which no stable plant could be drawn for the parameter " +
                           spread.parameter + "; allowed: a smaller one");
}

}  // namespace uncertainty_identification
