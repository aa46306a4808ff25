#include <algorithm>
#include <cmath>
#include <cstdio>

#include "data/wrapped_signal.h"
#include "identification/steps.h"
#include "math/polynomial.h"

/// Whether the data contradict the model, so that its bounds cannot be relied on.
namespace uncertainty_identification {
namespace {

constexpr int kFewest = 4;                // experiments that show how plants are distributed
constexpr double kImprobable = 1e-3;      // p-value
constexpr double kNoticeable = 0.03;      // correlation that matters, however improbable it is
constexpr double kNonlinear = 0.002;      // share of the residuals' variance that matters
constexpr double kLargestErrorRatio = 3;  // of robust and plain standard errors
constexpr double kLeastFit = 50;          // [%]
constexpr double kAlmostUnstable = 0.9995;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", value);
  return text;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

void addErrorRatio(const std::vector<ParameterEstimate>& parameters, int experiments,
                   std::vector<std::string>* reasons) {
  const ParameterEstimate* worst = nullptr;
  double highest = kLargestErrorRatio;
  for (const ParameterEstimate& parameter : parameters) {
    const double ratio = parameter.robust_standard_error / parameter.standard_error;
    if (!std::isfinite(ratio) || ratio < highest) continue;
    highest = ratio;
    worst = &parameter;
  }
  if (worst == nullptr) return;
  const bool one = experiments == 1;
  reasons->push_back((one ? "the parts of the record scatter " : "the experiments scatter ") +
                     number(highest) + " times as much in " + worst->name +
                     " as the model says (ratio of robust and plain standard error): the " +
                     (one ? "noise is not the model's, or the plant changes or is not linear"
                          : "experiments differ in a way that the error model cannot express"));
}

void addUndetermined(const std::vector<ParameterEstimate>& parameters,
                     std::vector<std::string>* reasons) {
  std::string names;
  for (const ParameterEstimate& one : parameters)
    if (!std::isfinite(one.standard_error)) names += (names.empty() ? "" : ", ") + one.name;
  if (names.empty()) return;
  reasons->push_back(
      "the data do not determine every parameter of the nominal model (" + names +
      " without a standard error): use smaller orders, or an input that excites more");
}

void addFit(double fit, std::vector<std::string>* reasons) {
  if (fit >= kLeastFit) return;
  reasons->push_back("the simulation of the nominal model explains little of the output (fit " +
                     number(fit) + " %)");
}

}  // namespace

bool isFarWorse(double held_out_fit, double fit) {
  constexpr double kFar = 2.5, kGood = 90;  // ratio of errors; [%] fit
  return held_out_fit < kGood && 100 - held_out_fit >= kFar * (100 - fit);
}

std::vector<FailedTest> failedTests(const ResidualTests& tests) {
  std::vector<FailedTest> failed;
  if (tests.samples == 0) return failed;
  const auto add = [&](const std::string& name, double p_value, const std::string& finding,
                       const std::string& advice) {
    failed.push_back({name, p_value, finding + " (p = " + number(p_value) + ")", advice});
  };
  if (tests.independence_p_value < kImprobable && largest(tests.cross_correlation) > kNoticeable)
    add("dependence on the input", tests.independence_p_value,
        "the residuals still depend on the input",
        "the plant has dynamics or a nonlinearity that the model lacks; try higher orders, or "
        "explain");
  if (tests.whiteness_p_value < kImprobable && largest(tests.autocorrelation) > kNoticeable)
    add("whiteness", tests.whiteness_p_value, "the residuals are not white",
        "the noise model, or the plant, lacks dynamics; try explain");
  if (tests.linearity_p_value < kImprobable && tests.nonlinear_share > kNonlinear)
    add("linearity", tests.linearity_p_value,
        "the residuals depend on the input as those of a plant that is not linear",
        "try explain, which looks for the cause");
  return failed;
}

Trust trustOf(const FittedModel& fitted, const Estimate& estimate) {
  std::vector<std::string> reasons;
  if (estimate.termination == Termination::stalled ||
      estimate.termination == Termination::iteration_limit ||
      estimate.termination == Termination::time_limit)
    reasons.push_back("the estimation did not converge: " + estimate.message);
  const int count = estimate.experiment_count;
  if (count > 1 && count < kFewest) {
    reasons.push_back(std::to_string(count) +
                      " experiments are too few to show how the plants are distributed; record at "
                      "least 8, better 20");
  }
  for (const FailedTest& test : failedTests(estimate.residual_tests))
    reasons.push_back(test.finding + ": " + test.advice);
  addErrorRatio(estimate.nominal_model.parameters, count, &reasons);
  addUndetermined(estimate.nominal_model.parameters, &reasons);
  // An error model may explain more of the output than the nominal model alone.
  if (fitted.model->regressors() == 0 && estimate.simulation_fit_percent)
    addFit(*estimate.simulation_fit_percent, &reasons);
  if (!isStable(estimate.nominal_model.a, kAlmostUnstable))
    reasons.push_back(
        "a pole of the nominal model is at the edge of stability: low frequencies are not "
        "determined");
  return {reasons.empty(), std::move(reasons)};
}

Trust trustOfLength(Trust trust, const Eigen::VectorXd& a, int longest) {
  constexpr double kFewest = 1.5;  // time constants
  if (isStable(a, std::exp(-kFewest / longest))) return trust;
  trust.trusted = false;
  trust.reasons.push_back(
      "even the longest experiment lasts less than one and a half of the slowest time constant: "
      "the gain and all that is slow are extrapolated; record longer, until the output settles");
  return trust;
}

Trust trustOfOrders(Trust trust, const std::vector<Candidate>& candidates, long poles,
                    std::optional<double> fit) {
  const std::string of_order = " na=" + std::to_string(poles) + " ";
  for (const Candidate& candidate : candidates) {
    if (!fit || candidate.choice != "orders" || !candidate.chosen || !candidate.validation_fit ||
        candidate.description.find(of_order) == std::string::npos ||
        !isFarWorse(*candidate.validation_fit, *fit))
      continue;
    trust.trusted = false;
    trust.reasons.push_back(
        "with the chosen orders, parts of the data that were held out are simulated far worse "
        "(fit " +
        number(*candidate.validation_fit) + " %) than those fitted to (" + number(*fit) +
        " %): the data are too few for these orders, or the plant changes or is not linear");
  }
  return trust;
}

Trust trustOfInputs(Trust trust, const CheckedData& data) {
  constexpr int kFewestMoved = 3;
  if (std::any_of(data.experiments.begin(), data.experiments.end(), wrapsOf)) {
    trust.trusted = false;
    trust.reasons.push_back(
        "the output jumps from one end of its range to the other, as an angle does that starts "
        "again at 0 after 360 degrees: record it unwrapped");
  }
  if (data.movedInputs() >= std::min(data.count(), kFewestMoved)) return trust;
  trust.trusted = false;
  trust.reasons.push_back(
      "nearly all inputs are constant from the first sample on: another gain, an offset and a slow "
      "disturbance of an experiment look the same there, so how the gain differs is not known; "
      "begin the records before the step, at rest");
  return trust;
}

Trust trustOfDirection(Trust trust, const Following& following, int delay, bool delay_is_chosen) {
  if (following.inputFollows())
    trust.reasons.push_back(
        "the input follows the output, as in a closed loop: noise that a controller feeds back "
        "biases the model, which the bounds do not include");
  if (delay > 0 && following.at_once.matters())
    trust.reasons.push_back(
        "what is new in the input and in the output appears in the same sample, although the model "
        "answers later: a controller probably computes the input from the output, and the noise "
        "that it feeds back biases the model");
  if (delay == 0 && delay_is_chosen && following.moveTogether())
    trust.reasons.push_back(
        "the input and the output move within the same sample, so the data do not show which "
        "causes the other: where a controller computes the input from the output, this model is "
        "the inverse of the controller. If the output really answers at once, state "
        "nominal_model: {delay: 0} and the orders; otherwise record an input that does not depend "
        "on the output");
  trust.trusted = trust.reasons.empty();
  return trust;
}

Trust trustAfterValidation(Trust trust, const Validation& validation, std::optional<double> fit) {
  if (validation.experiments.empty()) return trust;
  const double held_out = validation.simulation_fit_percent_pooled;
  if (held_out < kLeastFit)
    trust.reasons.push_back(
        "the simulation of the nominal model explains little of the validation experiments (fit " +
        number(held_out) + " %)");
  else if (fit && isFarWorse(held_out, *fit))
    trust.reasons.push_back(
        "the validation experiments are simulated far worse (fit " + number(held_out) +
        " %) than those fitted to (" + number(*fit) +
        " %): they differ by more than the model knows, or the plant is not linear; explain tells "
        "whether by gain, offset or dead time");
  trust.trusted = trust.reasons.empty();
  return trust;
}

Trust trustAfterCalibration(Trust trust, const PredictionCalibration& calibration) {
  constexpr double kLargestRatio = 1.5;
  for (std::size_t k = 0; k < calibration.levels.size(); ++k) {
    const double ratio = calibration.radius[k] / calibration.model_radius[k];
    if (!std::isfinite(ratio) || ratio < kLargestRatio) continue;
    trust.trusted = false;
    trust.reasons.push_back("the simulation errors of experiments that were left out are " +
                            number(ratio) + " times as large as the model expects");
    break;
  }
  return trust;
}

}  // namespace uncertainty_identification
