#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "uncertainty_identification/bounds/prediction_calibration.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Where a running identification stands. Returning false from the callback cancels it.
struct Progress {
  std::string phase;    ///< "checking the data", "choosing orders", "starting values",
                        ///< "optimising", "standard errors", ...
  double fraction = 0;  ///< of the whole, 0 to 1; never decreases
  std::optional<double> log_likelihood;  ///< absent before there is one
};
using ProgressCallback = std::function<bool(const Progress&)>;

/// Makes the nominal model for data of a sample time [s].
using NominalModelFactory = std::function<std::shared_ptr<const NominalModel>(double)>;

/// The class that everything else is a front end of: experiments in, estimate out.
/// The same experiments, configuration and version give the same estimate, whatever the number of
/// threads.
class Identifier {
 public:
  /// Throws ConfigurationError when the configuration is not valid.
  explicit Identifier(Configuration configuration);

  /// The same with a nominal model of the caller's own (docs/adding_a_nominal_model.md) in place of
  /// configuration.nominal_model. Throws ConfigurationError also for `orders: auto` and `fit:
  /// simulation` there, which are for Box-Jenkins models.
  Identifier(Configuration configuration, NominalModelFactory nominal_model);

  const Configuration& configuration() const { return configuration_; }

  /// Estimates nominal model, noise model and error distribution by maximum likelihood (paper,
  /// Lemma 1). Experiments that fail the checks are left out and listed in the result. `validation`
  /// experiments only measure. Throws DataError when no usable experiment is left or the orders are
  /// too large for the data. Not converging, or being cancelled, is told by Estimate::termination.
  Estimate identify(const std::vector<Experiment>& experiments,
                    const std::vector<Experiment>& validation = {},
                    const ProgressCallback& progress = {}) const;

  /// The same, started from an earlier estimate of the same structure (a re-identification with
  /// more experiments).
  Estimate reidentify(const Estimate& previous, const std::vector<Experiment>& experiments,
                      const ProgressCallback& progress = {}) const;

  /// Calibrates prediction intervals: identifies again, from `estimate` on, without one fold of the
  /// experiments after the other (configuration.bounds.folds of them). No folds in the result when
  /// the experiments are fewer than two, or `progress` cancels. A fold that cannot be fitted is
  /// left out with a warning; throws DataError where fewer than two folds remain.
  PredictionCalibration calibrate(const Estimate& estimate,
                                  const std::vector<Experiment>& experiments,
                                  const ProgressCallback& progress = {}) const;

 private:
  Configuration configuration_;
  NominalModelFactory nominal_model_;  ///< empty: configuration_ names the model
};

}  // namespace uncertainty_identification
