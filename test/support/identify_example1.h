#pragma once

#include <vector>

#include "support/core_setup.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace test {

inline std::vector<Experiment> example1Experiments(int experiments, std::uint64_t seed = 1) {
  return example1(seed, experiments).experiments;
}

inline Estimate identified(const Configuration& configuration,
                           const std::vector<Experiment>& experiments) {
  return Identifier(configuration).identify(experiments);
}

}  // namespace test
}  // namespace uncertainty_identification
