#include "io/result_text.h"

#include <cmath>
#include <vector>

#include "estimation/mean_plant.h"
#include "io/text_table.h"
#include "math/polynomial.h"
#include "model/sensitivity.h"
#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {
namespace {

using Rows = std::vector<std::vector<std::string>>;

void addParameters(const std::vector<ParameterEstimate>& parameters, Rows* rows) {
  for (const ParameterEstimate& parameter : parameters) {
    rows->push_back({parameter.name, numberText(parameter.value),
                     numberText(parameter.standard_error),
                     numberText(parameter.robust_standard_error), parameter.unit});
  }
}

std::string thinningText(int thinning) {
  if (thinning <= 1) return "";
  return ": " + std::to_string(thinning) + " samples of the data, of which the first output and " +
         "the mean input are used (estimation.thinning)";
}

std::string nominalModelText(const Estimate& estimate) {
  const NominalModelEstimate& model = estimate.nominal_model;
  return "Nominal model: " + model.structure + ", delay " + std::to_string(model.delay) +
         (model.delay == 1 ? " sample" : " samples") + ", sample time " +
         numberText(model.sample_time) + " s" +
         thinningText(estimate.configuration.estimation.thinning) + "\n" +
         textTable({{"B =", polynomialText(model.b, model.delay)},
                    {"A =", polynomialText(withLeadingOne(model.a), 0)},
                    {"C =", polynomialText(withLeadingOne(model.c), 0)},
                    {"D =", polynomialText(withLeadingOne(model.d), 0)}});
}

std::string parametersText(const Estimate& estimate) {
  Rows rows{{"parameter", "value", "standard error", "robust", "unit"}};
  addParameters(estimate.nominal_model.parameters, &rows);
  addParameters({estimate.noise_variance}, &rows);
  addParameters(estimate.error_model.parameters, &rows);
  return "Parameters\n" + textTable(rows);
}

std::string parameterList(const ErrorModelOptions& options) {
  std::string list;
  for (const std::string& name : options.parameters) list += (list.empty() ? "" : ", ") + name;
  const bool second = options.basis == BasisKind::sensitivity && options.sensitivity_order == 2;
  return list + (second ? " and products of two" : "");
}

std::string errorModelText(const ErrorModelEstimate& model) {
  const Mixture& mixture = model.mixture;
  if (mixture.components() == 0 || mixture.dimension() == 0) return "Error model: none\n";
  Rows rows{{"component", "weight", "mean", "covariance"}};
  for (std::size_t i = 0; i < mixture.weights.size(); ++i) {
    rows.push_back({std::to_string(i + 1), numberText(mixture.weights[i]),
                    vectorText(mixture.means[i]), matrixText(mixture.covariances[i])});
  }
  if (variesParameters(model.options.basis)) {
    return "Error model: " + nameOf(model.options.basis) + " of " + parameterList(model.options) +
           "; mixture of the relative deviations xi, " + nameOf(model.options.constraint) + "\n" +
           textTable(rows);
  }
  return "Error model: " + nameOf(model.options.basis) + ", " + std::to_string(model.T.rows()) +
         " taps, " + nameOf(model.options.constraint) +
         "; mixture of xi (eta = T xi, T = " + matrixText(model.T) + ")\n" + textTable(rows);
}

std::string simulationText(const Estimate& estimate) {
  if (!estimate.simulation_fit_percent || !std::isfinite(*estimate.simulation_fit_percent))
    return "";
  const bool is_go = meanPlant(estimate).b.size() == estimate.nominal_model.b.size();
  return std::string("The simulation of the ") +
         (is_go ? "nominal model" : "mean plant, Go (1 + mean of GDelta),") +
         " fits the experiments that it was identified from by " +
         numberText(*estimate.simulation_fit_percent) + " % (100 (1 - |y - ysim|/|y - mean y|))\n";
}

std::string fitText(const Estimate& estimate) {
  std::string text = "Noise variance " + numberText(estimate.noise_variance.value) +
                     ", offset of u " + numberText(estimate.offset_u) + ", of y " +
                     numberText(estimate.offset_y) + "\n";
  text += "Log-likelihood " + numberText(estimate.log_likelihood) + ", BIC " +
          numberText(estimate.bic) + ", from " + std::to_string(estimate.experiment_count) +
          " experiments with " + std::to_string(estimate.sample_count) + " samples\n";
  return text + "Ended: " + toString(estimate.termination) + " after " +
         std::to_string(estimate.iterations) + " iterations, " + std::to_string(estimate.passes) +
         " passes, " + numberText(estimate.seconds) + " s; " + estimate.message + "\n";
}

std::string candidatesText(const std::vector<Candidate>& candidates) {
  if (candidates.empty()) return "";
  Rows rows{{"choice", "candidate", "parameters", "log-likelihood", "BIC", "held-out fit [%]",
             "held-out density", ""}};
  for (const Candidate& candidate : candidates) {
    rows.push_back({candidate.choice, candidate.description, std::to_string(candidate.parameters),
                    numberText(candidate.log_likelihood), numberText(candidate.bic),
                    numberText(candidate.validation_fit), numberText(candidate.held_out_density),
                    candidate.chosen ? "chosen" : ""});
  }
  return "Candidates\n" + textTable(rows);
}

std::string validationText(const Validation& validation) {
  if (validation.experiments.empty()) return "";
  Rows rows{{"experiment", "simulation fit [%]"}};
  for (std::size_t i = 0; i < validation.experiments.size(); ++i) {
    rows.push_back({validation.experiments[i], numberText(validation.simulation_fit_percent[i])});
  }
  rows.push_back({"all together", numberText(validation.simulation_fit_percent_pooled)});
  rows.push_back(
      {"all together, if each began at rest", numberText(validation.at_rest_fit_percent_pooled)});
  return "Validation, log density per experiment " +
         numberText(validation.log_density_per_experiment) + "\n" + textTable(rows);
}

std::string trustText(const Trust& trust) {
  if (trust.trusted) return "";
  std::string text = "Do not rely on the uncertainty of this model:\n";
  for (const std::string& reason : trust.reasons) text += "  - " + reason + "\n";
  return text;
}

std::string findingsText(const Estimate& estimate) {
  std::string text;
  for (const RejectedExperiment& rejected : estimate.rejected) {
    text += "Rejected " + rejected.id + ": " + rejected.reason + "\n";
  }
  for (const std::string& warning : estimate.warnings) text += "Warning: " + warning + "\n";
  return text;
}

}  // namespace

std::string resultText(const Estimate& estimate, const std::string& sentence) {
  const auto line = [](const std::string& text) { return text.empty() ? "" : text + "\n"; };
  return trustText(estimate.trust) + line(sentence) + line(estimate.variation) +
         nominalModelText(estimate) + simulationText(estimate) +
         errorModelText(estimate.error_model) + parametersText(estimate) + fitText(estimate) +
         candidatesText(estimate.candidates) + validationText(estimate.validation) +
         findingsText(estimate);
}

namespace {

std::string predictionText(const PredictionCalibration& calibration) {
  Rows rows{{"share of experiments", "guaranteed", "radius", "by the model"}};
  for (std::size_t k = 0; k < calibration.levels.size(); ++k) {
    rows.push_back({numberText(100 * calibration.levels[k]) + " %",
                    numberText(100 * calibration.guaranteed[k]) + " %",
                    numberText(calibration.radius[k]), numberText(calibration.model_radius[k])});
  }
  std::string text = "Largest simulation error in a new experiment, calibrated (" +
                     calibration.method + ", " + std::to_string(calibration.folds.size()) +
                     " folds)\n" + textTable(rows);
  for (const std::string& warning : calibration.warnings) text += "Warning: " + warning + "\n";
  return text;
}

}  // namespace

std::string baselineText(const Baseline& baseline) {
  const bool mem = baseline.method == BaselineMethod::mem;
  Rows rows{{"parameter", "mean", "standard deviation between experiments"}};
  for (Eigen::Index k = 0; k < baseline.mean.size(); ++k) {
    rows.push_back({baseline.fits.front().parameters[static_cast<std::size_t>(k)].name,
                    numberText(baseline.mean[k]), numberText(baseline.deviation[k])});
  }
  std::string text = std::to_string(baseline.fits.size()) +
                     " experiments, each fitted separately\n" + textTable(rows);
  if (baseline.magnitude_bands.empty()) return text;
  Rows bands{{"share of experiments", "|G| at the lowest frequency", "at the highest"}};
  for (const Band& band : baseline.magnitude_bands.pointwise) {
    const auto limits = [&band](Eigen::Index k) {
      return numberText(band.lower[k]) + " to " + numberText(band.upper[k]);
    };
    bands.push_back(
        {numberText(100 * band.level) + " %", limits(0), limits(band.lower.size() - 1)});
  }
  return text + "Bands of " + (mem ? "their mean with the error models" : "the fitted plants") +
         "\n" + textTable(bands);
}

namespace {

/// How many frequencies lie below the one from which on nothing is known of the plant.
Eigen::Index knownFrequencies(const FrequencyBounds& frequency) {
  const Eigen::VectorXd& omega = frequency.omega;
  if (!frequency.hidden_from) return omega.size();
  const Eigen::Index known = (omega.array() < *frequency.hidden_from).count();
  return std::max<Eigen::Index>(known, 1);
}

}  // namespace

std::string boundsText(const Bounds& bounds) {
  const auto& bands = bounds.frequency.magnitude_bands;
  const auto& errors = bounds.frequency.relative_error;
  const bool total = !bands.total.empty();
  const Bands& magnitude = total ? bands.total : bands.mixture;
  const Bands& error = total ? errors.total : errors.mixture;
  const Eigen::Index known = knownFrequencies(bounds.frequency);
  Rows rows{{"share of plants", "|G| at the lowest frequency", "largest |G/Go - 1|", "at [rad/s]"}};
  for (std::size_t k = 0; k < bounds.levels.size(); ++k) {
    Eigen::Index at = 0;
    const double largest = error.simultaneous[k].upper.head(known).maxCoeff(&at);
    rows.push_back({numberText(100 * bounds.levels[k]) + " %",
                    numberText(magnitude.pointwise[k].lower[0]) + " to " +
                        numberText(magnitude.pointwise[k].upper[0]),
                    numberText(largest), numberText(bounds.frequency.omega[at])});
  }
  std::string text = "Bounds, from " + std::to_string(bounds.samples) + " plants drawn, " +
                     (total ? "including" : "not including") + " the errors of the estimate" +
                     "\n" + textTable(rows);
  if (bounds.frequency.hidden_from) {
    text += "From " + numberText(*bounds.frequency.hidden_from) +
            " rad/s on, noise hides what the input causes: there the bands say only that the plant "
            "is not known\n";
  }
  if (bounds.weight) {
    const UncertaintyWeight& weight = *bounds.weight;
    text += "G = Go (1 + W Delta): W of order " + std::to_string(weight.order) + " bounds the " +
            "relative error of " + numberText(100 * weight.level_held) +
            " % of the plants at all frequencies; |W| is " +
            numberText(weight.over_bounding_median) + " times the bound in the median\n";
  }
  if (bounds.prediction) text += predictionText(*bounds.prediction);
  for (const std::string& warning : bounds.warnings) text += "Warning: " + warning + "\n";
  return text;
}

}  // namespace uncertainty_identification
