#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace uncertainty_identification {

/// Purposes of random numbers. Every purpose has its own stream, so that enabling one source of
/// randomness does not change the numbers of the others. The values determine which numbers a seed
/// gives: append new ones and never renumber.
enum class RandomPurpose : std::uint32_t {
  input = 1,
  system = 2,
  noise = 3,
  missing = 4,
  plant = 5,
  amplitude = 6,
  temperature = 7,
  second_input = 8,
  effects = 9,  ///< one draw per experiment of each effect that has one
  parameter_spread = 10,
  mode = 11,
  tails = 12,
  outliers = 13,
  dropout = 14,
  jitter = 15,
  telegraph = 16,
  burst = 17,
  truth = 18  ///< a truth itself, drawn
};

/// The random numbers for one purpose in experiment r. They depend on the seed, r and the purpose
/// only, not on the number of experiments.
std::mt19937_64 randomStream(std::uint64_t seed, int r, RandomPurpose purpose);

/// `count` draws of N(0, variance).
Eigen::VectorXd gaussian(int count, double variance, std::mt19937_64& random);

}  // namespace uncertainty_identification
