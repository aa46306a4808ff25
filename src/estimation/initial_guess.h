#pragma once

#include <optional>
#include <vector>

#include "estimation/finalists.h"
#include "model/linear_model.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// Starts for the nominal model in the manner of the paper's section 5: prediction-error fits
/// (least squares, refined by Steiglitz-McBride) pooled over all experiments, and of each
/// experiment alone with the median of their coefficients taken; the noise model from their
/// residuals (Hannan-Rissanen) and from fixed guesses. In the model's parameters; empty where no
/// start is admissible.
std::vector<Eigen::VectorXd> nominalStarts(const LinearModel& model,
                                           const NominalModelOptions& options,
                                           const std::vector<Experiment>& experiments);

/// Starts for the noise model around a given Go (its b, a, delay) and offset, from Go's residuals.
std::vector<Eigen::VectorXd> noiseStarts(const LinearModel& model, const Polynomials& plant,
                                         double offset, const std::vector<Experiment>& experiments);

/// Starts for a model around a given noise model (its c and d): Go by the same least squares as
/// nominalStarts().
std::vector<Eigen::VectorXd> plantStarts(const LinearModel& model, const Polynomials& noise,
                                         const std::vector<Experiment>& experiments);

/// A start fitted with a single Gaussian component.
using SingleComponent = Finalist;

/// The best `wanted` of `starts`, no more than two of them with the same Go, each fitted by three
/// scoring steps, best first. Those that meet in doing so count once.
std::vector<SingleComponent> rankedSingleComponents(const Likelihood& likelihood,
                                                    const std::vector<Eigen::VectorXd>& starts,
                                                    std::size_t wanted,
                                                    OptimisationOptions options);

/// The optima with a single Gaussian component that the best starts lead to, highest first: each
/// approached by scoring steps, and only those that the mixture may still bring to the top. Empty
/// where the likelihood is not finite at any start.
std::vector<SingleComponent> singleComponentOptima(const Likelihood& likelihood,
                                                   const std::vector<Eigen::VectorXd>& starts,
                                                   const OptimisationOptions& options);

/// The highest of singleComponentOptima(); none where there is none.
std::optional<ModelParameters> bestSingleComponent(const Likelihood& likelihood,
                                                   const std::vector<Eigen::VectorXd>& starts,
                                                   const OptimisationOptions& options);

/// What spreadComponents() takes from a log-likelihood for components that hold fewer than two
/// experiments, which a component may shrink onto at no cost.
double smallComponentPenalty(const Mixture& mixture, int experiments);

/// A mixture of kappa components for given statistics, started from a fit with one: the paper's
/// evenly spread means, and `restarts` seeded draws from the experiments' posterior means, each
/// followed by EM at fixed theta. Returns the one of highest log-likelihood, less a penalty for
/// components that hold fewer than two experiments.
ModelParameters spreadComponents(const Likelihood& likelihood, const Statistics& statistics,
                                 const ModelParameters& single, int components, int restarts,
                                 std::uint64_t seed, const OptimisationOptions& options,
                                 double* log_likelihood);

}  // namespace uncertainty_identification
