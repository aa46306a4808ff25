#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Drops curves that do not tell the cause: a play of the output that is hardly wider than the
/// steps in which the sensor of these experiments reads, a gain that changes with time in sweeps,
/// whose frequency does as well, and any with which the simulation fits by less than 60 %.
void dropDoubtfulCurves(const std::vector<Experiment>& fitted, SimulationCauses* simulation);

/// "act_deadzone, plant_drag": the curves that the free simulation shows.
std::string namesOf(const SimulationCauses& simulation);

/// Whether the curves take away at least half of the squared error of simulating held-out data.
/// Where they take away a quarter, noise of the sensor, which nothing predicts, does not count.
bool takeHalfAway(const SimulationCauses& simulation);

/// Drops curves that do not take half of the squared error away, and says so in a sentence; empty
/// where there are none. Whatever else is wrong takes part of its error away by
/// some curve. For models whose residuals still show it.
std::string dropCurvesThatLeaveMost(SimulationCauses* simulation);

}  // namespace uncertainty_identification
