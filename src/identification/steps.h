#pragma once

#include <optional>
#include <vector>

#include "estimation/linearisation.h"
#include "estimation/standard_errors.h"
#include "identification/problem.h"

/// The steps of an identification, in their order (identify.cpp).
namespace uncertainty_identification {

/// The experiments that pass the checks, thinned where the configuration says so. Throws DataError
/// when none does.
CheckedData checkData(const Configuration& configuration,
                      const std::vector<Experiment>& experiments, Journal* journal);

/// The configuration with what the data say of the state before the first samples, where it is
/// automatic, and a prior of initial values that suits their scale.
Configuration chooseInitialState(Configuration configuration, const CheckedData& data,
                                 Journal* journal);

/// The configuration with Offsets::automatic replaced: an offset of each experiment's own where
/// simple models describe the data better with it and simulate them as well; otherwise, for fewer
/// than three experiments, for single steps and for starts at rest one in common.
Configuration chooseOffsets(const Problem& problem, Journal* journal);

/// Whether there are enough experiments, with inputs that excite enough, to show offsets of their
/// own: where the input is constant, an offset and another gain are the same. Experiments that
/// start at rest start at the common one unless levelsAtRestDiffer().
/// False also for offsets of the input, and where parameters are given, by the configuration or by
/// a previous result.
bool mayHaveOwnOffsets(const Problem& problem);

/// Variance of all measured outputs about their common mean.
double outputVariance(const std::vector<Experiment>& experiments);

/// Whether the experiments start at rest: whether their first outputs are as near to a simulation
/// that starts there as all others are to one that starts from the best state. False for fewer than
/// three experiments, which may start near rest by chance, and where the simulation leaves more
/// than a quarter of the variance, so that it cannot tell.
bool startAtRest(const std::vector<Experiment>& experiments, const EstimationOptions& options);

/// Whether experiments that start at rest do so at levels of their own: whether their first
/// readings scatter far more than what a model of each experiment's own leaves.
bool levelsAtRestDiffer(const std::vector<Experiment>& experiments,
                        const EstimationOptions& options);

/// Whether the state before the first samples is unknown, by the options or, where they leave it to
/// the data, by startAtRest().
bool mayStartAnywhere(const EstimationOptions& options, const std::vector<Experiment>& experiments);

/// The common offset of the output with which Go simulates the data: that of the fitted plant where
/// there is one, because noise that wanders leaves the offset beside it undetermined.
double offsetOf(const Problem& problem, const LinearModel& model, const ModelParameters& point);

/// The configuration with an error model that so many experiments can determine.
Configuration limitErrorModel(Configuration configuration, int experiments, Journal* journal);

/// The configuration with the largest dead time that the data speak for, where one is estimated: a
/// longer numerator would only add unknown initial values.
Configuration limitDeadTime(const Problem& problem);

/// The configuration with orders of the nominal model chosen, where they are automatic.
Configuration chooseOrders(const Problem& problem, Journal* journal);

/// Chooses the orders of the nominal model where they are automatic, and fits Go to its simulation
/// where the configuration asks for it. A Go with an oscillation that no experiment sees decay
/// explains noise by its initial states; smaller orders are chosen then, unless the input excites
/// the oscillation and they simulate far worse.
void choosePlant(Problem* problem, Journal* journal);

/// Go fitted to its free simulation; none where the configuration fits it together with the rest.
/// Throws DataError where there is no start.
std::optional<FittedPlant> fitPlant(const Problem& problem, Journal* journal);

/// Adds Go's parameters with their errors to the problem's fitted plant.
FittedPlant describePlant(const Problem& problem, Journal* journal);

/// Go and the common offset at a model's parameters.
FittedPlant plantOf(const LinearModel& model, const ModelParameters& point);

/// What is left to be fitted by likelihood.
struct ModelChoice {
  Configuration configuration;  ///< with error model and, where the orders are free, noise model
  bool plant_is_fixed;          ///< at the problem's fitted plant
  Eigen::VectorXd start;        ///< of the model's parameters; empty: none
  std::optional<ModelParameters> reached{};  ///< as in Problem
  Eigen::MatrixXd points{};                  ///< as in Problem, if all experiments are in it
};

/// Takes over what was chosen of another problem of the same data.
void takeOver(const Problem& other, Problem* problem);

/// Makes the choice that of the problem.
void adopt(const ModelChoice& choice, Problem* problem);

/// By what the orders of Go are chosen where the error model is not: the simulation alone, or the
/// likelihood of all orders up to those, with a noise model.
enum class Orders { of_simulation, of_likelihood };

/// Chooses the error model where it is automatic and, where the `asked` orders are, those of C and
/// D by BIC, and whether Go is fitted together with them: structures with one component are fitted
/// to (a part of) the data and compared by BIC, those nearly as good by held-out experiments. Fills
/// in the names of the parameters that vary where the error model varies some. Throws DataError
/// where none can be fitted.
ModelChoice chooseModel(const Problem& problem, const Configuration& asked, Orders orders,
                        Journal* journal);

/// The same around the problem's fitted plant, which stays as it is.
ModelChoice chooseAroundPlant(const Problem& problem, const Configuration& asked, Journal* journal);

/// Whether the request or its configuration gives a start of the parameters, or of the mixture.
bool hasGivenParameters(const Problem& problem);
const Mixture& givenMixture(const Problem& problem);  ///< without components where none is given

/// The given start of a model's parameters. Throws ConfigurationError where it is not admissible or
/// of the wrong size.
Eigen::VectorXd givenParameters(const Problem& problem, const LinearModel& model);

/// Starts of the model's parameters from the data, best guess first; empty where there are none.
std::vector<Eigen::VectorXd> startsFromData(const Problem& problem, const LinearModel& model);

/// The points of modes that differ, which were found one by one; empty for other structures.
Eigen::MatrixXd pointsToStartFrom(const Problem& problem, const LinearModel& model);

/// The linearisation about the posterior means at `start` or, where the likelihood is higher, about
/// the points to start from. None for models that are linear.
std::optional<Linearisation> linearisedToStart(const Problem& problem, const LinearModel& model,
                                               const ModelParameters& start, Journal* journal);

/// `found`, by bestSingleComponent(). Throws DataError where there is none, or none that is stable.
ModelParameters requireStart(const std::optional<ModelParameters>& found, const LinearModel& model);

/// Where the optimisation starts: the given point, or the best start with the number of components
/// of least BIC where it is automatic. Throws DataError where there is none.
ModelParameters findStart(const Problem& problem, const LinearModel& model,
                          const Likelihood& likelihood, Journal* journal);

/// A point of higher likelihood than the optimum, by moves that a climb cannot make; none where
/// none is found.
std::optional<ModelParameters> higherElsewhere(const Problem& problem, const FittedModel& fitted,
                                               const OptimisationOptions& options);

/// The point with the time constants of a continuous structure in ascending order; they are
/// interchangeable unless the error model varies one of them.
ModelParameters withSortedTimeConstants(const LinearModel& model, const ErrorModelOptions& errors,
                                        ModelParameters point);

/// The model at the highest optimum of its likelihood that is found. Throws DataError where the
/// data have too few samples for it, or where there is no start.
FittedModel fitModel(const Problem& problem, Journal* journal);

/// The result but for what the journal holds.
Estimate describe(const Problem& problem, const FittedModel& fitted, Journal* journal);

/// Standard errors at an estimate. Of experiments that are too few to show by their scores how the
/// parameters scatter, parts of them are compared, if there is no error model: the robust errors of
/// one record hold where its residuals are not white.
StandardErrors errorsOfFit(const Likelihood& likelihood, const Parametrisation& parametrisation,
                           const ModelParameters& point);

/// The parameters in the result with their standard errors, and the covariances.
void describeParameters(const Problem& problem, const FittedModel& fitted, Journal* journal,
                        Estimate* estimate);

/// The model of the structure that is chosen. Where Go was fitted jointly, but alone simulates the
/// data better, it is the model around the plant that was fitted alone, if there is one. Of a
/// single experiment, whose orders are free, both ways to choose them are tried, as neither finds
/// every optimum: the model of less BIC is taken unless it simulates worse.
FittedModel fitChosen(const Configuration& asked, Problem* problem, Journal* journal);

/// Chooses the plant's orders and the structure. Where offsets are automatic, the one in common was
/// chosen, and the time constant of the noise is longer than a third of the longest experiment, all
/// is chosen once more with offsets of the experiments' own, which such noise may stand for. These
/// are taken where the likelihood of all samples less the penalty of BIC is higher, and the
/// simulation no worse, or where the tests of the residuals find nothing wrong with these alone.
FittedModel fitWithOffsets(const Configuration& asked, Problem* problem, Journal* journal);

/// How the plants differ from experiment to experiment, as a sentence; empty for one experiment.
std::string variationText(const Estimate& estimate, const LinearModel& model);

/// Whether the sentence of the estimate tells a difference that the likelihood clearly asks for.
bool plantsDiffer(const Estimate& estimate);

/// A test of the residuals that fails, by so much that it matters.
struct FailedTest {
  std::string name;  ///< "dependence on the input", "whiteness" or "linearity"
  double p_value = 0;
  std::string finding;  ///< what it found, with its p-value
  std::string advice;   ///< what this means, and what to try
};

/// The tests of the residuals of one-step predictions that fail.
std::vector<FailedTest> failedTests(const ResidualTests& tests);

/// Whether the data contradict the model: residual tests, standard errors that disagree with the
/// scatter of the experiments, a poor simulation, too few experiments.
Trust trustOf(const FittedModel& fitted, const Estimate& estimate);

/// The same for a plant with denominator `a` and experiments of which the `longest` [samples] may
/// be too short for its slowest time constant.
Trust trustOfLength(Trust trust, const Eigen::VectorXd& a, int longest);

/// The same for orders that were chosen among `candidates` by simulation and kept, for a plant with
/// that many poles whose simulation fits its own experiments by `fit` [%]: parts that were held out
/// may have been simulated far worse.
Trust trustOfOrders(Trust trust, const std::vector<Candidate>& candidates, long poles,
                    std::optional<double> fit);

/// The same for data of which hardly any input changes: constant ones do not show how gains differ;
/// and for an output that wraps as an angle does.
Trust trustOfInputs(Trust trust, const CheckedData& data);

/// The same for data in which the input may follow the output, as that of a controller does.
/// `delay` of Go [samples], which was concluded from the data or stated.
Trust trustOfDirection(Trust trust, const Following& following, int delay, bool delay_is_chosen);

/// Whether data that were not fitted to are simulated far worse [% of fit] than those that were,
/// and not well.
bool isFarWorse(double held_out_fit, double fit);

/// The same after simulating experiments that were not fitted; those that were fit by `fit` [%].
Trust trustAfterValidation(Trust trust, const Validation& validation, std::optional<double> fit);

/// How well the model predicts experiments that it was not fitted to.
Validation validate(const Problem& problem, const FittedModel& fitted, InitialState asked,
                    const std::vector<Experiment>& experiments, Journal* journal);

}  // namespace uncertainty_identification
