#pragma once

#include <vector>

#include "uncertainty_identification/baselines/prediction_error.h"

namespace uncertainty_identification {

/// Order of the error models of the paper's section 5.2.
constexpr int kModelErrorOrder = 10;

/// Model error modelling (the paper's section 5.2 after Reinelt, Garulli and Ljung): what the mean
/// of the prediction-error fits leaves of each experiment, epsilon = y - Go u, explained by an FIR
/// model of its own,
///   epsilon_r = G_epsilon,r u_r + v_r,   G_epsilon,r = q^-delay (e1 + e2 q^-1 + ...) (42)
struct ModelErrorModels {
  Polynomials nominal;              ///< Go, the mean of the fits
  std::vector<ExperimentFit> fits;  ///< G_epsilon,r: b holds e1, e2, ...
};

/// Throws DataError when fewer than two experiments can be fitted.
ModelErrorModels modelErrorModels(const Configuration& configuration,
                                  const PredictionErrorFits& nominal,
                                  const std::vector<Experiment>& experiments,
                                  int order = kModelErrorOrder);

/// Go + G_epsilon,r of all experiments: the region is made of these, frequency by frequency. (The
/// paper adds the error models' average, which is a curve and no region; docs/paper.md.)
PlantSamples plantsOf(const ModelErrorModels& models, double sample_time);

}  // namespace uncertainty_identification
