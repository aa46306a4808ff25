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

/// The prediction-error estimate from one experiment alone: maximum likelihood without error model.
struct ExperimentFit {
  std::string id;
  std::vector<ParameterEstimate> parameters;  ///< theta with standard errors
  int delay = 0;                              ///< [samples]
  Eigen::VectorXd b, a, c, d;                 ///< as in NominalModelEstimate
  double offset = 0;                          ///< common offset, if one is estimated
  double noise_variance = 0;
  double log_likelihood = 0;
};

/// The fits of all experiments and their mean.
struct PredictionErrorFits {
  std::shared_ptr<const NominalModel> nominal;
  std::vector<ExperimentFit> fits;
  std::vector<RejectedExperiment> failed;  ///< experiments for which no estimate was found
  Eigen::VectorXd mean;                    ///< mean of theta
  Eigen::MatrixXd covariance;              ///< sample covariance of theta over the experiments
  double offset = 0, noise_variance = 0;   ///< means
};

/// Fits each experiment separately (the experiments have passed the checks). Structure and nuisance
/// options are those of the configuration; the orders must be given. Throws DataError when fewer
/// than two experiments can be fitted, ConfigurationError for `orders: auto`.
PredictionErrorFits fitExperiments(const Configuration& configuration,
                                   std::shared_ptr<const NominalModel> nominal,
                                   const std::vector<Experiment>& experiments);

/// The plants of the fits, without error model.
PlantSamples plantsOf(const PredictionErrorFits& fits, double sample_time);

/// The mean of the fits as an estimate without error model: parameters with the standard errors of
/// the mean, and the likelihood of all experiments at this mean.
Estimate meanEstimate(const Configuration& configuration, const PredictionErrorFits& fits,
                      const std::vector<Experiment>& experiments);

/// Bands of |G| over omega [rad/s] that contain a given share of the plants. Only those of the
/// levels for which there are enough plants.
Bands magnitudeBands(const PlantSamples& plants, const Eigen::VectorXd& omega,
                     const std::vector<double>& levels);

}  // namespace uncertainty_identification
