#pragma once

#include "estimation/simulation_fit.h"
#include "identification/structure_fit.h"

/// The plant in the middle of a distribution, and what its simulation is worth.
namespace uncertainty_identification {

/// Go (1 + GDelta) at the mean of the error parameters: Go, unless the error model is FIR and its
/// mean is free.
Polynomials meanPlant(const StructureFit& fit);

/// How well a plant with an offset [unit of y] simulates the problem's data, to be compared with
/// another's. Initial values are fitted to all samples, with an offset of each experiment's own:
/// otherwise a slow pole too many would look better, because its free response takes the place of
/// this offset.
SimulationFit fitOf(const Problem& problem, const Polynomials& plant, double offset);

/// Whether the squared errors of one simulation are noticeably larger than those of another, and by
/// more than their differences from experiment to experiment explain.
bool simulatesWorse(const SimulationFit& one, const SimulationFit& other);

}  // namespace uncertainty_identification
