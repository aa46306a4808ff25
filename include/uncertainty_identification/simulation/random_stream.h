#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace uncertainty_identification {

/// What random numbers are drawn for. Every purpose has its own stream, so that switching one on
/// leaves the numbers of the others as they were. Values are part of what a seed means: append,
/// never renumber.
enum class RandomPurpose : std::uint32_t {
  input = 1,
  system = 2,
  noise = 3,
  missing = 4,
  plant = 5
};

/// The random numbers of one purpose in experiment r: they depend on nothing else, the number of
/// experiments included.
std::mt19937_64 randomStream(std::uint64_t seed, int r, RandomPurpose purpose);

/// `count` draws of N(0, variance).
Eigen::VectorXd gaussian(int count, double variance, std::mt19937_64& random);

}  // namespace uncertainty_identification
