#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"

/// Machines as differential equations, which share no code with the package.
namespace uncertainty_identification::rigs {

/// A machine x' = f(x, u, parameters), y = h(x, parameters), with what is nonlinear in it.
struct Rig {
  using Values = std::vector<double>;

  std::string name;
  double sample_time = 0;  ///< [s]
  double amplitude = 1;    ///< of the input, which is drawn anew every 5 to 40 samples
  double offset = 0;       ///< of the input
  Values initial;
  Values parameters;  ///< each experiment draws its own: normal, deviation 3 %
  std::function<void(const Values& x, double u, const Values& parameters, Values* rates)>
      derivative;
  std::function<double(const Values& x, const Values& parameters)> output;
  /// What acts on the input before the equations see it, with a memory of its own; may be empty.
  std::function<double(double u, double time, const Values& parameters, double* memory)> actuator;
  /// What acts on the output, with a memory; may be empty.
  std::function<double(double y, const Values& parameters, double* memory)> sensor;
  /// What a right answer names, one list for each cause: "place/shape", or "place" where any shape
  /// is right. Empty: nothing.
  std::vector<std::vector<std::string>> causes;
};

const std::vector<Rig>& allRigs();

/// `count` experiments of `samples`; white noise of 1 % of the output's deviation.
std::vector<Experiment> record(const Rig& rig, int count, int samples, std::uint64_t seed);

}  // namespace uncertainty_identification::rigs
