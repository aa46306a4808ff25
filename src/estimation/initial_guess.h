#pragma once

#include <vector>

#include "estimation/climb.h"
#include "model/linear_model.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// Starts for the nominal model in the manner of the paper's section 5: prediction-error fits
/// (least squares, refined by Steiglitz-McBride) pooled over all experiments, and of each
/// experiment alone with the median of their coefficients taken; the noise model from what they
/// leave (Hannan-Rissanen, and fixed guesses beside it). In the model's parameters.
std::vector<Eigen::VectorXd> nominalStarts(const LinearModel& model,
                                           const NominalModelOptions& options,
                                           const std::vector<Experiment>& experiments);

/// Starts for a model around a given Go (its b, a, delay) and offset: the noise model from what Go
/// leaves.
std::vector<Eigen::VectorXd> noiseStarts(const LinearModel& model, const Polynomials& plant,
                                         double offset, const std::vector<Experiment>& experiments);

/// Starts for a model around a given noise model (its c and d): Go by the same least squares as
/// nominalStarts().
std::vector<Eigen::VectorXd> plantStarts(const LinearModel& model, const Polynomials& noise,
                                         const std::vector<Experiment>& experiments);

/// Where a start leads with a single Gaussian component.
struct SingleComponent {
  ModelParameters at;
  double log_likelihood = 0;
};

/// The best of `starts`, as many as wanted, each three scoring steps on, best first.
std::vector<SingleComponent> rankedSingleComponents(const Likelihood& likelihood,
                                                    const std::vector<Eigen::VectorXd>& starts,
                                                    std::size_t wanted, ClimbOptions options);

/// The start among `starts` that leads highest with a single Gaussian component, a few scoring
/// steps on.
ModelParameters bestSingleComponent(const Likelihood& likelihood,
                                    const std::vector<Eigen::VectorXd>& starts,
                                    ClimbOptions options);

/// A mixture of kappa components for given statistics, grown from a fit with one: the paper's
/// evenly spread means, and `restarts` seeded draws from the experiments' posterior means, each
/// followed by EM without a sweep; the highest likelihood wins, components that hold fewer than two
/// experiments counting against it.
ModelParameters spreadComponents(const Likelihood& likelihood, const Statistics& statistics,
                                 const ModelParameters& single, int components, int restarts,
                                 std::uint64_t seed, const ClimbOptions& options,
                                 double* log_likelihood);

}  // namespace uncertainty_identification
