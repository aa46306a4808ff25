#pragma once

#include <vector>

#include "curves/curve_candidates.h"

namespace uncertainty_identification {

/// Whether errors beyond differences between experiments are far larger than those of another
/// curve, which refutes this one: records that each have a linear plant of their own are simulated
/// far better with the other. False where one is empty.
bool isRefuted(const Eigen::VectorXd& beyond, const Eigen::VectorXd& beyond_of_other);

/// The same of curves at different places, by their `beyond`.
bool isRefuted(const CurveCandidate& curve, const CurveCandidate& other);

/// Drops the curves that simulate the records better as they are than another one, which refutes
/// them: they only imitate how experiments differ. Adds their errors beyond that to the curves,
/// where there are two places to choose from.
void dropImitations(const SimulationData& data, const SimulationData& held,
                    std::vector<CurveCandidate>* candidates);

}  // namespace uncertainty_identification
