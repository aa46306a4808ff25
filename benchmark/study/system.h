#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "study/family.h"
#include "study/signals.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification::study {

/// A family of plants and the experiments made with it.
struct System {
  std::uint64_t seed = 0;
  Family family;
  int experiments = 0, samples = 0;
  InputDesign input;
  NoiseDesign noise;
  double noise_deviation = 0;  ///< [unit of y]
  double offset = 0;           ///< [unit of y] added to all outputs
  int run_up = 0;              ///< samples before the record; 0 = the experiments start at rest
};

/// Draws everything but the number of experiments. Records have 50 to 1000 samples, fewer if the
/// experiments together would exceed `most_samples`.
System drawSystem(Kind kind, int experiments, int most_samples, std::uint64_t seed);

/// What is measured: each experiment has a plant of its own.
std::vector<Experiment> measure(const System& system);

/// 40 frequencies [rad/s], evenly spaced in the logarithm: from one period per record to 80 % of
/// the Nyquist frequency or, if that is lower, the highest frequency of a multisine.
Eigen::VectorXd excitedFrequencies(const System& system);

/// Responses of new plants of the family: plants x frequencies. For plants with a dead zone it is
/// the best linear approximation for this input.
Eigen::MatrixXcd freshResponses(const System& system, int plants, const Eigen::VectorXd& omega);

}  // namespace uncertainty_identification::study
