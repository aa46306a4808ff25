#pragma once

#include <Eigen/Core>
#include <cmath>
#include <random>

#include "math/random_stream.h"

/// Single random numbers.
namespace uncertainty_identification::test {

inline double uniform(double low, double high, std::mt19937_64& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A number from low to high whose logarithm is uniformly distributed.
inline double logUniform(double low, double high, std::mt19937_64& random) {
  return low * std::pow(high / low, uniform(0, 1, random));
}

/// True with this probability.
inline bool chance(double probability, std::mt19937_64& random) {
  return uniform(0, 1, random) < probability;
}

/// -1 or 1.
inline double sign(std::mt19937_64& random) { return chance(0.5, random) ? 1 : -1; }

/// A number whose magnitude is uniform from low to high, with a random sign.
inline double signedUniform(double low, double high, std::mt19937_64& random) {
  const double magnitude = uniform(low, high, random);
  return sign(random) * magnitude;
}

/// A whole number from low to high, both included.
inline int whole(int low, int high, std::mt19937_64& random) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

/// A unit vector in a random direction.
inline Eigen::VectorXd directionOf(int dimension, std::mt19937_64& random) {
  return gaussian(dimension, 1, random).normalized();
}

}  // namespace uncertainty_identification::test
