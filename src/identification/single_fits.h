#pragma once

#include <Eigen/Core>
#include <vector>

#include "identification/problem.h"
#include "identification/structure_fit.h"

/// Fits of single experiments, without an error model.
namespace uncertainty_identification {

/// The problem of a single experiment, without an error model.
Problem problemOf(const CheckedData& one, Configuration configuration);

/// At most so many of the experiments whose input moves, each as data of its own, with their
/// numbers among all.
std::vector<CheckedData> singles(const CheckedData& data, std::size_t most,
                                 std::vector<Eigen::Index>* numbers = nullptr);

/// Whether all poles of a sampled plant have a continuous counterpart: a1, a2, ... of A.
bool hasModes(const Eigen::VectorXd& a);

/// The plants of some experiments, all of the order and delay with which these together have the
/// least BIC, and most of them with modes. Empty where there are none.
std::vector<StartingPoint> plantsOfLeastBic(const Problem& problem,
                                            const std::vector<CheckedData>& data, Journal* journal);

}  // namespace uncertainty_identification
