#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "uncertainty_identification/bounds/bands.h"
#include "uncertainty_identification/bounds/plant_distribution.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// The prediction-error estimate of one experiment by itself: maximum likelihood without an error
/// model.
struct ExperimentFit {
  std::string id;
  std::vector<ParameterEstimate> parameters;  ///< theta with standard errors
  int delay = 0;                              ///< [samples]
  Eigen::VectorXd b, a, c, d;                 ///< as in NominalModelEstimate
  double offset = 0;                          ///< common offset, where one is estimated
  double noise_variance = 0;
  double log_likelihood = 0;
};

/// The experiments' fits and what they are in the mean.
struct PredictionErrorFits {
  std::shared_ptr<const NominalModel> nominal;
  std::vector<ExperimentFit> fits;
  std::vector<RejectedExperiment> failed;  ///< no estimate could be found
  Eigen::VectorXd mean;                    ///< of theta
  Eigen::MatrixXd covariance;              ///< of theta over the experiments (sample covariance)
  double offset = 0, noise_variance = 0;   ///< means
};

/// Fits each of the experiments by itself (they have passed the checks). The structure and the
/// nuisances are those of the configuration, the orders given. Throws DataError when fewer than two
/// experiments can be fitted, ConfigurationError for orders: auto.
PredictionErrorFits fitExperiments(const Configuration& configuration,
                                   std::shared_ptr<const NominalModel> nominal,
                                   const std::vector<Experiment>& experiments);

/// The fits' plants, without error model.
PlantSamples plantsOf(const PredictionErrorFits& fits, double sample_time);

/// The mean of the fits as an estimate without error model: parameters with the standard errors of
/// a mean, and the likelihood of all experiments there.
Estimate meanEstimate(const Configuration& configuration, const PredictionErrorFits& fits,
                      const std::vector<Experiment>& experiments);

/// Bands of |G| over omega [rad/s] that hold a share of given plants; of the levels those that so
/// many plants can tell.
Bands magnitudeBands(const PlantSamples& plants, const Eigen::VectorXd& omega,
                     const std::vector<double>& levels);

}  // namespace uncertainty_identification
