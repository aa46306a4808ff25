#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "effects/extended_model.h"
#include "estimation/likelihood.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/effects/catalogue.h"

/// Helpers for tests of effects.
namespace uncertainty_identification::test {

/// Eleven experiments (two blocks, the second not full) of 35 to 50 samples at 0.5 s, with all that
/// an effect may ask for: covariates `temp` (constant in each) and `flow` (a signal), stamps off
/// the grid. Output of a first-order plant in white noise.
std::vector<Experiment> recordedForEffects();

/// A first-order Box-Jenkins model, two free error parameters without static gain, at rest.
Configuration effectConfiguration();

/// The linear model of a configuration extended by effects, with experiments and their likelihood.
class EffectSetup {
 public:
  explicit EffectSetup(const Configuration& configuration = effectConfiguration(),
                       std::vector<Experiment> experiments = recordedForEffects());

  const std::vector<Experiment>& experiments() const { return experiments_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const DataSummary& summary() const { return summary_; }
  const Effects& all() const { return all_; }  ///< the catalogue for these data
  const LinearModel& linear() const { return *linear_; }

  /// Effects by name and variant.
  std::unique_ptr<ExtendedModel> extended(
      const std::vector<std::pair<std::string, std::string>>& effects) const;
  std::unique_ptr<ExtendedModel> extendedBy(const Effects& effects) const;

  /// theta (and a common offset) of the linear part, a mixture of two components, sigma^2; then
  /// `psi`.
  ModelParameters at(const Eigen::VectorXd& psi = {}) const;

  /// Log-likelihood of each experiment, and one at `at`.
  Eigen::VectorXd logLikelihoods(const LinearModel& model, const ModelParameters& at) const;

  /// Free simulation of each experiment with xi = 0 (or, given, its column).
  std::vector<Eigen::VectorXd> simulated(const ExtendedModel& model,
                                         const Eigen::VectorXd& parameters,
                                         const Eigen::MatrixXd& xi = {}) const;

 private:
  std::vector<Experiment> experiments_;
  std::vector<Block> blocks_;
  EstimationOptions options_;
  std::shared_ptr<const NominalModel> nominal_;
  ErrorBasis basis_;
  DataSummary summary_;
  Effects all_;
  std::unique_ptr<LinearModel> linear_;
};

/// Parameters at which an effect does nothing: exactly, but for random effects, whose variance is
/// as small as it may be.
Eigen::VectorXd neutral(const Effect& effect);

/// Parameters at which it does something that the data of recordedForEffects() show.
Eigen::VectorXd noticeable(const Effect& effect);

}  // namespace uncertainty_identification::test
