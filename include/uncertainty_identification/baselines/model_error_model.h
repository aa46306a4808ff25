#pragma once

#include <vector>

#include "uncertainty_identification/baselines/prediction_error.h"

namespace uncertainty_identification {

/// Order of the error models in section 5.2 of the paper.
constexpr int kModelErrorOrder = 10;

/// Model error modelling (section 5.2 of the paper, after Reinelt, Garulli and Ljung). The residual
/// of each experiment from the mean of the prediction-error fits, epsilon = y - Go u, is described
/// by an FIR model of its own,
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

/// Go + G_epsilon,r of every experiment. The region at each frequency is made from these plants.
/// (The paper adds the average of the error models instead, which gives a curve and not a region;
/// see docs/paper.md.)
PlantSamples plantsOf(const ModelErrorModels& models, double sample_time);

}  // namespace uncertainty_identification
