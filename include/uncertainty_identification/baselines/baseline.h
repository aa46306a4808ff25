#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/baselines/model_error_model.h"
#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {

/// Methods that stochastic embedding is compared with.
enum class BaselineMethod {
  pem,  ///< a prediction-error estimate of every experiment separately
  mem   ///< model error modelling: FIR models of each experiment's residual from the mean model
};

const EnumNames<BaselineMethod>& enumNames(BaselineMethod);

/// The result of a baseline method.
struct Baseline {
  BaselineMethod method = BaselineMethod::pem;
  std::vector<ExperimentFit> fits;          ///< one per experiment
  Eigen::VectorXd mean, deviation;          ///< mean and standard deviation of the fits' parameters
  std::vector<ExperimentFit> error_models;  ///< mem: b holds e1, e2, ...
  Eigen::VectorXd omega;                    ///< [rad/s]
  /// Bands of |G|. pem: over the plants of the experiments. mem: over the mean plus each error
  /// model. Contains only those levels for which there are enough experiments.
  Bands magnitude_bands;
};

/// The result as an estimate (the mean of the fits, without error model) and in detail.
struct BaselineResult {
  Estimate estimate;
  Baseline baseline;
};

/// Runs a baseline method. Experiments that fail the checks are left out. Throws ConfigurationError
/// for `orders: auto`, DataError where the experiments cannot be fitted separately.
BaselineResult identifyBaseline(BaselineMethod method, const Configuration& configuration,
                                const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
