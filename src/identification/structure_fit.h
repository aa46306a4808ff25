#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "identification/error_structures.h"

namespace uncertainty_identification {

/// A start for structures of the same orders.
struct StartingPoint {
  Polynomials polynomials;  ///< Go and H
  double offset = 0;        ///< common, of the output
};

/// An error structure with a single Gaussian component, near its highest likelihood.
struct StructureFit {
  ErrorStructure structure;
  std::shared_ptr<const LinearModel> model;  ///< linearised about the posterior means where need be
  ModelParameters point;
  double log_likelihood = 0;  ///< of all but the first samples, see firstSamplesDensity()
  int parameters = 0;         ///< of theta, offset and sigma^2
  int mixture = 0;            ///< of the error model
  Eigen::MatrixXd points{};   ///< of the linearisation, a column for each experiment

  StartingPoint start() const;  ///< Go, H and the offset at `point`
};

/// Number of free parameters of the error model of a configuration: of the mixture and, where it
/// varies a plant along directions, of the subspace that these span.
int mixtureParameters(const Configuration& configuration, int dimension, int components);

/// Half BIC, higher is better: log-likelihood less half of the penalty [nats].
double scoreOf(const Problem& problem, const StructureFit& fit);

/// Fits a structure to the data of a problem, from starting points and, with `from_data`, also from
/// the starts that the data give. None where the likelihood is not finite at any start.
std::optional<StructureFit> fitStructure(const Problem& problem, const ErrorStructure& structure,
                                         const std::vector<StartingPoint>& points, bool from_data,
                                         Journal* journal);

/// The same from one point of the whole model, with error parameters `xi` of the experiments, a
/// column each: near plants that differ much.
std::optional<StructureFit> fitStructureFrom(const Problem& problem,
                                             const ErrorStructure& structure,
                                             const ModelParameters& start,
                                             const Eigen::MatrixXd& xi, Journal* journal);

/// The fit of least BIC or, among those whose half BIC is nearly as low, the simplest one that
/// predicts held-out experiments as well as the best. Adds all to the journal's candidates.
/// Throws DataError where there is none.
StructureFit bestOf(const Problem& problem, const std::vector<StructureFit>& fits,
                    const std::string& choice, bool by_held_out, Journal* journal);

/// The fit, or that of a larger Go (by a coefficient, a pole, or a shorter or fractional delay) as
/// long as BIC improves and, with `only_if_dependent`, the residuals depend on the input.
StructureFit withBetterOrders(const Problem& problem, StructureFit fit, bool only_if_dependent,
                              Journal* journal);

/// The fit, or one with a further lag in place of delay and zeros of a chain of lags, if that is
/// better: a short delay often stands for lags that are faster than the samples show.
StructureFit withLagForDelay(const Problem& problem, StructureFit fit, Journal* journal);

/// The error model with which orders are compared: a gain that varies from experiment to experiment
/// or, of a single one, none.
ErrorStructure structureForOrders(const Problem& problem);

/// The best model of nb = na = `order` with that error model, with the delay of least BIC.
std::optional<StructureFit> fitOfOrder(Problem problem, int order, Journal* journal);

/// Models whose gain varies, unless there is a single experiment, and whose noise is coloured: that
/// of least BIC among all orders and delays, followed by the best ones with fewer and fewer poles.
/// The simulation alone, by which the problem's orders were chosen, is a poor judge where plants
/// differ or noise drifts: the free response of a slow pole too many follows what another gain, or
/// the drift, leaves. Empty where none can be fitted.
std::vector<StructureFit> jointOrders(const Problem& problem,
                                      const std::vector<StartingPoint>& points, Journal* journal);

/// The structure with C and D of the orders of least BIC, up to the first that gain nothing.
StructureFit withNoiseOrders(const Problem& problem, const StructureFit& chosen, Journal* journal);

/// Whether the plants may differ by filters: enough of them are known, and the chosen structure is
/// one, or varies the dead time, or a filter of several taps, or coefficients of B that vary
/// together, describe them about as well.
bool mayBeFilters(const Problem& problem, const std::vector<StructureFit>& fits,
                  const StructureFit& chosen);

/// The best model whose plants differ by FIR filters of the input with a free mean and no error of
/// the static gain, the paper's own structure, with orders of its own. None where none can be
/// fitted.
std::optional<StructureFit> fitFilters(const Problem& problem, Journal* journal);

/// The best model of a sum of modes of which some parameters vary, with orders and a start that
/// single experiments show. None where there are too few experiments, or none can be fitted.
std::optional<StructureFit> fitModes(Problem problem, Journal* journal);

/// The model of a configuration that states directions along which modes differ, from what single
/// experiments show. None where it states none, or a start, or there are too few experiments.
std::optional<StructureFit> fitStatedModes(const Problem& problem, Journal* journal);

/// Half BIC of a fit by what follows the first samples of each experiment, wherever it starts
/// [nats]: comparable between fits with and without unknown values of each experiment's own.
double scoreAfterFirstSamples(const Problem& problem, const StructureFit& fit, Journal* journal);

/// The fit or, where BIC is lower, that with an offset of each experiment's own in place of the
/// common one, with the same noise model or white noise: noise that wanders may stand for offsets.
StructureFit withBetterOffsets(const Problem& problem, StructureFit fit, Journal* journal);

/// The fit or, where its dead time is a whole number of samples within a tenth and BIC improves,
/// that of the structure with this delay in place of the dead time: at its lower limit a dead time
/// has no standard error.
StructureFit withWholeDelay(const Problem& problem, StructureFit fit, Journal* journal);

/// Mean log density of experiments that the structure was not fitted to [nats], over folds of the
/// problem's experiments; each fold starts from the fit to all of them.
double heldOutDensity(const Problem& problem, const StructureFit& fit, Journal* journal);

}  // namespace uncertainty_identification
