#pragma once

#include <optional>
#include <vector>

#include "identification/problem.h"

/// The steps of an identification, in their order (identify.cpp).
namespace uncertainty_identification {

/// The experiments that pass the checks. Throws DataError when none does.
CheckedData checkData(const Configuration& configuration,
                      const std::vector<Experiment>& experiments, Journal* journal);

/// The configuration with an error model that so many experiments can determine.
Configuration limitErrorModel(Configuration configuration, int experiments, Journal* journal);

/// The configuration with orders of the nominal model chosen, where they are automatic.
Configuration chooseOrders(const Problem& problem, Journal* journal);

/// Go fitted to its free simulation; none where the configuration fits it together with the rest.
/// Throws DataError where there is no start.
std::optional<FittedPlant> fitPlant(const Problem& problem, Journal* journal);

/// Adds Go's parameters with their errors to the problem's fitted plant.
FittedPlant describePlant(const Problem& problem, Journal* journal);

/// Go and the common offset at a model's parameters.
FittedPlant plantOf(const LinearModel& model, const ModelParameters& point);

/// The configuration with the orders of C and D that have the lowest BIC with the fitted plant
/// fixed.
Configuration chooseNoiseOrders(const Problem& problem, Journal* journal);

/// The configuration with the number of taps of least BIC where it is automatic, and with the names
/// of the parameters that vary where the error model varies some.
Configuration chooseErrorModel(const Problem& problem, Journal* journal);

/// Whether the request or its configuration gives a start of the parameters, or of the mixture.
bool hasGivenParameters(const Problem& problem);
const Mixture& givenMixture(const Problem& problem);  ///< without components where none is given

/// The given start of a model's parameters. Throws ConfigurationError where it is not admissible or
/// of the wrong size.
Eigen::VectorXd givenParameters(const Problem& problem, const LinearModel& model);

/// Starts of the model's parameters from the data, best guess first; empty where there are none.
std::vector<Eigen::VectorXd> startsFromData(const Problem& problem, const LinearModel& model);

/// `found`, by bestSingleComponent(). Throws DataError where there is none, or none that is stable.
ModelParameters requireStart(const std::optional<ModelParameters>& found, const LinearModel& model);

/// Where the optimisation starts: the given point, or the best start with the number of components
/// of least BIC where it is automatic. Throws DataError where there is none.
ModelParameters findStart(const Problem& problem, const LinearModel& model,
                          const Likelihood& likelihood, Journal* journal);

/// The model at the optimum of its likelihood. Throws DataError where the data have too few samples
/// for it, or where there is no start.
FittedModel fitModel(const Problem& problem, Journal* journal);

/// The result but for what the journal holds. Cancelled or not, the model is described; the tests
/// and standard errors are absent once the caller has cancelled.
Estimate describe(const Problem& problem, const FittedModel& fitted, Journal* journal);

/// The parameters in the result with their standard errors (NaN once the caller has cancelled), and
/// the covariances.
void describeParameters(const Problem& problem, const FittedModel& fitted, Journal* journal,
                        Estimate* estimate);

/// How well the model predicts experiments that it was not fitted to.
Validation validate(const Problem& problem, const FittedModel& fitted,
                    const std::vector<Experiment>& experiments, Journal* journal);

}  // namespace uncertainty_identification
