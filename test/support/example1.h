#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/truth_yaml.h"
#include "simulation/simulate.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification {

/// The paper's Example 1 in small: as many experiments of 100 samples as asked for.
inline std::vector<Experiment> example1Experiments(int count) {
  Truth truth = loadTruth(std::string(PROJECT_FOLDER) + "/config/example1_truth.yaml");
  truth.experiments = count;
  return simulate(truth, 1);
}

/// The same, recorded in front of an actuator that does not answer to commands below `width`; of
/// another seed other experiments.
inline std::vector<Experiment> example1BehindDeadZone(int count, double width,
                                                      std::uint64_t seed = 1) {
  Truth truth = loadTruth(std::string(PROJECT_FOLDER) + "/config/example1_truth.yaml");
  truth.experiments = count;
  std::vector<Experiment> experiments = simulate(truth, seed);
  for (Experiment& experiment : experiments) {
    experiment.u += width * experiment.u.cwiseSign();
    experiment.id += "_of_seed_" + std::to_string(seed);
  }
  return experiments;
}

/// How it is identified.
inline Configuration example1Configuration() {
  return loadConfiguration(std::string(PROJECT_FOLDER) + "/config/example1.yaml");
}

}  // namespace uncertainty_identification
