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

/// The progress of a running identification. The callback that receives it returns false to cancel.
struct Progress {
  std::string phase;    ///< "checking the data", "choosing orders", "starting values",
                        ///< "optimising", "standard errors", ...
  double fraction = 0;  ///< of the whole identification, 0 to 1; never decreases
  std::optional<double> log_likelihood;  ///< absent until one has been computed
};
using ProgressCallback = std::function<bool(const Progress&)>;

/// Creates the nominal model for data with the given sample time [s].
using NominalModelFactory = std::function<std::shared_ptr<const NominalModel>(double)>;

/// Identifies a model from experiments. The tools and the node use this class. The same
/// experiments, configuration and version give the same estimate, whatever the number of threads.
class Identifier {
 public:
  /// Throws ConfigurationError when the configuration is not valid.
  explicit Identifier(Configuration configuration);

  /// Uses a nominal model defined by the caller (docs/adding_a_nominal_model.md) instead of
  /// configuration.nominal_model. Throws ConfigurationError also if the configuration has `orders:
  /// auto` or `fit: simulation`, which are available for Box-Jenkins models only.
  Identifier(Configuration configuration, NominalModelFactory nominal_model);

  const Configuration& configuration() const { return configuration_; }

  /// Estimates nominal model, noise model and error distribution by maximum likelihood (paper,
  /// Lemma 1). Experiments that fail the checks are left out and listed in the result. The
  /// `validation` experiments are not used for fitting, only to measure the fit. Throws DataError
  /// when no usable experiment is left or the orders are too large for the data.
  /// Estimate::termination tells whether the estimation converged or was cancelled.
  Estimate identify(const std::vector<Experiment>& experiments,
                    const std::vector<Experiment>& validation = {},
                    const ProgressCallback& progress = {}) const;

  /// The same, starting from an earlier estimate of the same structure (identification with
  /// additional experiments).
  Estimate reidentify(const Estimate& previous, const std::vector<Experiment>& experiments,
                      const ProgressCallback& progress = {}) const;

  /// Calibrates prediction intervals by cross-validation: for each of configuration.bounds.folds
  /// folds, identifies without this fold, starting from `estimate`. The result has no folds if
  /// there are fewer than two experiments or `progress` cancels. A fold that cannot be fitted is
  /// left out with a warning; throws DataError if fewer than two folds remain.
  PredictionCalibration calibrate(const Estimate& estimate,
                                  const std::vector<Experiment>& experiments,
                                  const ProgressCallback& progress = {}) const;

 private:
  Configuration configuration_;
  NominalModelFactory nominal_model_;  ///< empty: configuration_ defines the model
};

/// The trust in an estimate, given how well it predicted the experiments that were left out: none
/// where their simulation errors are larger than the model expects.
Trust trustAfterCalibration(Trust trust, const PredictionCalibration& calibration);

}  // namespace uncertainty_identification
