#pragma once

#include "estimation/simulation_fit.h"
#include "identification/structure_fit.h"

/// The plant in the middle of a distribution, what its simulation is worth, and whether the plants
/// about it exist.
namespace uncertainty_identification {

/// Go (1 + GDelta) at the mean of the error parameters: Go, unless the error model is FIR and its
/// mean is free.
Polynomials meanPlant(const LinearModel& model, const ModelParameters& point);
inline Polynomials meanPlant(const StructureFit& fit) { return meanPlant(*fit.model, fit.point); }

/// Whether plants exist 1.6 standard deviations from the mean along each principal axis of
/// parameters that vary, so on nearly all draws. They do not where a dead time near zero varies to
/// both sides: it then stands for something else.
bool plantsExist(const StructureFit& fit);

/// Whether the mean plant simulates the data as well as `chosen_alone`, Go of the orders that
/// simulate best, or as Go of its own orders that is fitted to nothing else, and then not much
/// worse than `chosen_alone`. It does not where the plant is not linear, and the likelihood accepts
/// a worse simulation for a better prediction. Where plants differ, the best simulation of these
/// few leads to another Go than the mean of the plants; it is then better in some experiments only.
bool simulatesAsWellAsAlone(const Problem& problem, const LinearModel& model,
                            const ModelParameters& point, const FittedPlant& chosen_alone,
                            Journal* journal);

/// Whether the experiments are more than twice as many as the elements of the covariance of what
/// varies between them. True where nothing varies.
bool areMany(const Problem& problem, const LinearModel& model);

/// Whether the data are simulated far better by each experiment's own plant, whose parameters are
/// at their posterior means, than by `chosen_alone`: with half of its error. Where a resonance
/// varies, the plant that simulates all experiments best has more damping than any of them. Filters
/// of few experiments simulate anything; their mean must not be much worse, unless the experiments
/// are many and hardly an error is left. Of modes that differ, three plants of four are enough.
bool simulatesByOwnPlants(const Problem& problem, const FittedModel& fitted,
                          const FittedPlant& chosen_alone);

/// How well the mean plant simulates experiments, from the initial state that the options state.
SimulationFit meanPlantFit(const LinearModel& model, const ModelParameters& point, double offset,
                           const EstimationOptions& options,
                           const std::vector<Experiment>& experiments);

/// How well a plant with an offset [unit of y] simulates the problem's data.
SimulationFit fitOf(const Problem& problem, const Polynomials& plant, double offset);

/// Whether the squared errors of one simulation are noticeably larger than those of another, and by
/// more than their differences from experiment to experiment explain.
bool simulatesWorse(const SimulationFit& one, const SimulationFit& other);

}  // namespace uncertainty_identification
