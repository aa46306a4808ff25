#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// Free parameters of a mixture under a constraint.
int mixtureParameters(Constraint constraint, int dimension, int components);

/// Marks the candidate of least BIC among those from `first` on as chosen and returns its index.
/// Where no BIC is finite none is chosen.
std::optional<std::size_t> chooseLeastBic(std::size_t first, std::vector<Candidate>* candidates);

/// Called between candidates with the share done; returning false ends the choice with the best so
/// far.
using SelectionProgress = std::function<bool(double)>;

/// Orders of C and D, nc = nd, tried by the automatic choices.
constexpr int kLargestNoiseOrder = 3;

/// Orders and delay from the data (docs/method.md, section on automatic choices). Focus simulation:
/// output-error structure, by free simulation of experiments kept out of the fit (the last third of
/// each where there are fewer than three), the smallest model within a tolerance of the best; to be
/// fitted to its simulation. Focus prediction: all orders by BIC, to be fitted to the likelihood.
/// Appends every candidate tried.
NominalModelOptions selectOrders(const Configuration& configuration, double sample_time,
                                 const std::vector<Experiment>& experiments, int threads,
                                 std::vector<Candidate>* candidates,
                                 const SelectionProgress& progress);

}  // namespace uncertainty_identification
