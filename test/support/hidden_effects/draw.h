#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "uncertainty_identification/simulation/random_stream.h"

/// Single draws.
namespace uncertainty_identification::test {

inline double uniform(double low, double high, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// low to high, all ratios equally likely.
inline double logUniform(double low, double high, std::mt19937_64& random) {
  return low * std::pow(high / low, uniform(0, 1, random));
}

inline bool chance(double probability, std::mt19937_64& random) {
  return uniform(0, 1, random) < probability;
}

inline double sign(std::mt19937_64& random) { return chance(0.5, random) ? 1 : -1; }

inline double signedUniform(double low, double high, std::mt19937_64& random) {
  const double magnitude = uniform(low, high, random);
  return sign(random) * magnitude;
}

/// low to high, both included.
inline int whole(int low, int high, std::mt19937_64& random) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

/// A unit vector, all directions equally likely.
inline Eigen::VectorXd directionOf(int dimension, std::mt19937_64& random) {
  return gaussian(dimension, 1, random).normalized();
}

}  // namespace uncertainty_identification::test
