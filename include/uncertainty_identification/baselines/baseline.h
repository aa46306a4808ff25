#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/baselines/model_error_model.h"
#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {

/// Methods that the stochastic embedding is compared with.
enum class BaselineMethod {
  pem,  ///< prediction-error estimates of each experiment by itself
  mem   ///< model error modelling: FIR models of what their mean leaves of each experiment
};

const EnumNames<BaselineMethod>& enumNames(BaselineMethod);

/// What a baseline makes of the experiments.
struct Baseline {
  BaselineMethod method = BaselineMethod::pem;
  std::vector<ExperimentFit> fits;          ///< of each experiment by itself
  Eigen::VectorXd mean, deviation;          ///< of their parameters
  std::vector<ExperimentFit> error_models;  ///< mem: b holds e1, e2, ...
  Eigen::VectorXd omega;                    ///< [rad/s]
  /// Of |G|: pem, the experiments' own plants; mem, the mean plus their error models. Holds the
  /// levels that so many experiments can tell.
  Bands magnitude_bands;
};

/// A baseline's result: the mean of the fits as a model without error model, and the rest.
struct BaselineResult {
  Estimate estimate;
  Baseline baseline;
};

/// Experiments that fail the checks are left out. Throws ConfigurationError for orders: auto,
/// DataError where the experiments cannot be fitted by themselves.
BaselineResult identifyBaseline(BaselineMethod method, const Configuration& configuration,
                                const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
