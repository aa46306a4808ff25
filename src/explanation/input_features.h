#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "explanation/fit.h"

namespace uncertainty_identification {

/// Products of generic features of the input with each other and with the residual, which should be
/// uncorrelated with all of them. Features are shifts, powers and absolute values of the input,
/// powers of the simulated output, products of the two, gains and constants that change over time,
/// and covariates.
struct FeatureProducts {
  std::vector<std::string> names;  ///< of the features, in words
  Eigen::MatrixXd gram;            ///< of the whitened features with each other
  Eigen::VectorXd cross;           ///< of the whitened features with the residual
};

/// Sums over all measured samples. The features pass through the noise model's whitening 1/H as the
/// residual did. `residual` has one signal per block.
FeatureProducts featureProducts(const Fit& fit, const FitData& data,
                                const std::vector<Signals>& residual);

}  // namespace uncertainty_identification
