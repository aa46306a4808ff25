#pragma once

#include <memory>
#include <string>
#include <vector>

#include "uncertainty_identification/own_simulation/simulation.h"

namespace uncertainty_identification {

/// [%] below which a linear model of a simulation says nothing about it.
constexpr double kLeastSurrogateFit = 90;

/// A simulation that cannot be run with other values, extended by a linear model of it: its own
/// output, plus what the linear model says that other parameters change. The parameters are those
/// of the linear model: gain, tau1, omega1, zeta1, ...
struct LinearSurrogate {
  std::unique_ptr<Simulation> simulation;  ///< refers to the one it was made of; null: no fit
  Simulation* linear = nullptr;            ///< the linear model, which `simulation` holds
  double fit = 0;  ///< [%] of the simulation's output by the linear model, without noise
};

/// A linear simulation, and its fit [%] to the outputs that it was identified from; null where no
/// stable one was found.
struct LinearFit {
  std::unique_ptr<Simulation> simulation;
  double fit = 0;
};

/// Identifies a linear model of order 1 to 3 whose free simulation from rest is y of the
/// experiments; `description` as in Simulation.
LinearFit fitLinear(const std::vector<Experiment>& answers, const std::string& description);

/// The parameters' own values, in their order.
Eigen::VectorXd ownValuesOf(const Simulation& simulation);

/// Identifies the linear model, of order 1 to 3, from what the simulation answers to the inputs of
/// the experiments. There is none where its fit is below 90 %.
LinearSurrogate fitSurrogate(Simulation& simulation, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
