#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// Number of free parameters of a mixture under a constraint.
int mixtureParameters(Constraint constraint, int dimension, int components);

/// Marks the candidate with the lowest BIC among those from index `first` on as chosen, and returns
/// its index. Absent if no BIC is finite.
std::optional<std::size_t> chooseLeastBic(std::size_t first, std::vector<Candidate>* candidates);

/// Called between candidates with the completed share. Returning false ends the choice; the best
/// candidate so far is taken.
using SelectionProgress = std::function<bool(double)>;

/// Largest order of C and D, nc = nd, that the automatic choices try.
constexpr int kLargestNoiseOrder = 3;

/// Chooses orders and delay from the data (docs/method.md, section on automatic choices).
/// Focus simulation: output-error models are compared by their free simulation of data that they
/// were not fitted to: a third of the experiments at a time, or of each if there are fewer than
/// three. The smallest model whose simulation is as good as the best one's, as far as the data can
/// tell, is chosen, and is then fitted to its simulation error.
/// Focus prediction: all orders are chosen by BIC, and the model is then fitted by likelihood.
/// Appends all candidates to the list.
NominalModelOptions selectOrders(const Configuration& configuration, double sample_time,
                                 const std::vector<Experiment>& experiments, int threads,
                                 std::vector<Candidate>* candidates,
                                 const SelectionProgress& progress);

}  // namespace uncertainty_identification
