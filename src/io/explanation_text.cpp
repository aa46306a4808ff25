#include "io/explanation_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "io/own_simulation_text.h"
#include "io/text_table.h"
#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {
namespace {

using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t kTriedShown = 5;

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return std::isfinite(value) ? text : "-";
}

std::string percentText(double share) { return shortNumber(100 * share) + " %"; }

std::string countText(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string intervalText(double lower, double upper) {
  if (!std::isfinite(lower) || !std::isfinite(upper)) return "-";
  return shortNumber(lower) + " to " + shortNumber(upper);
}

std::string nameText(const std::string& name, const std::string& variant) {
  return variant.empty() ? name : name + " (" + variant + ")";
}

std::string probabilityText(double p_value) {
  if (p_value < 1e-16) return "p < 1e-16";
  char text[32];
  std::snprintf(text, sizeof text, "p = %.2g", p_value);
  return std::isfinite(p_value) ? text : "p = -";
}

std::string outcomeText(const Check& check) {
  if (check.passed) return "passes";
  return "FAILS, " + probabilityText(check.p_value) +
         (check.where.empty() ? "" : ", " + check.where);
}

/// Outcomes of the tests without the causes and, if there are any, with them. Tests that fail
/// without the causes come first.
std::string checksText(const Explanation& explanation) {
  const bool twice = !explanation.causes.empty();
  std::vector<Check> before = explanation.checks_before;
  const auto failed = [](const Check& check) { return !check.passed; };
  const auto passed = std::stable_partition(before.begin(), before.end(), failed);
  if (passed == before.begin() && !twice) {
    return "All " + countText(before.size(), "test") + " of the residuals pass.\n";
  }
  Rows rows{{"Test of the residuals", "without the causes", "with them"}};
  if (!twice) rows[0] = {"Test of the residuals", ""};
  for (const Check& check : before) {
    rows.push_back({check.name, outcomeText(check)});
    if (!twice) continue;
    const auto& after = explanation.checks_after;
    const auto same = std::find_if(after.begin(), after.end(), [&check](const Check& candidate) {
      return candidate.name == check.name;
    });
    rows.back().push_back(same == after.end() ? "-" : outcomeText(*same));
  }
  return textTable(rows);
}

std::string parametersText(const std::vector<CauseParameter>& parameters) {
  Rows rows;
  for (const CauseParameter& parameter : parameters) {
    const std::string unit = parameter.unit.empty() ? "" : " [" + parameter.unit + "]";
    rows.push_back({parameter.name + unit, estimateText(parameter.value, parameter.standard_error),
                    "90 %: " + intervalText(parameter.lower_90, parameter.upper_90)});
  }
  return rows.empty() ? "" : textTable(rows);
}

std::string gainText(const Gain& gain, std::size_t held_out) {
  const auto change = [](const Comparison& values) {
    return shortNumber(values.before) + " -> " + shortNumber(values.after);
  };
  const Comparison& inside = gain.coverage_95;
  const std::string measured = held_out == 0
                                   ? "the experiments used for fitting"
                                   : countText(held_out, "experiment") + " not used for fitting";
  return "  On " + measured + ":\n" +
         textTable(
             {{"gain per experiment [nats]", estimateText(gain.log_density, gain.standard_error),
               "90 %: " + intervalText(gain.lower_90, gain.upper_90)},
              {"simulation fit [%]", change(gain.nrmse_fit_percent)},
              {"samples in 95 % intervals [%]", change({100 * inside.before, 100 * inside.after})},
              {"noise variance", change(gain.noise_variance)},
              {"95 % Bode region [dec x dec]", change(gain.bode_area)}});
}

/// A posterior probability among the candidates is none where all of them leave something wrong, or
/// where not all were tried.
std::string confidenceText(const Cause& cause, bool all_explained) {
  if (!std::isfinite(cause.confidence) && cause.simulation) return "found in the free simulation";
  if (!std::isfinite(cause.confidence)) return "no probability, since not all causes were tried";
  if (all_explained) return "probability " + percentText(cause.confidence);
  return "the best of the catalogue; tests still fail, so it has no probability";
}

std::string placeText(const PlaceAndShape& what) {
  return what.place + (what.covariate.empty() ? "" : " [" + what.covariate + "]") +
         (what.shape == what.place ? "" : ": " + what.shape);
}

/// Where the simulation shows it, what else explains it as well, and its curve at five points.
std::string simulationText(const SimulationCause& cause) {
  Rows rows{{"place and shape", placeText(cause.what)},
            {"fit of held-out windows [%]",
             shortNumber(cause.fit_before) + " -> " + shortNumber(cause.fit_after)}};
  for (const PlaceAndShape& tie : cause.ties)
    rows.push_back({"or, as well", placeText(tie) + " (" + tie.name + ")"});
  const CurvePicture& curve = cause.curve;
  for (std::size_t k = 0; k < curve.signal.size();
       k += std::max<std::size_t>(1, (curve.signal.size() - 1) / 4))
    rows.push_back({"curve at " + curve.of + " " + shortNumber(curve.signal[k]),
                    shortNumber(curve.value[k]) +
                        ", 90 %: " + intervalText(curve.lower_90[k], curve.upper_90[k])});
  return textTable(rows);
}

std::string causeText(const Cause& cause, std::size_t number, const Explanation& explanation) {
  std::string text = "\nCause " + std::to_string(number) + ": " +
                     nameText(cause.name, cause.variant) + ", " + cause.group + ", " +
                     confidenceText(cause, explanation.verdict == Verdict::explained) + "\n";
  if (!cause.description.empty()) text += "  " + cause.description + "\n";
  for (const std::string& name : cause.equivalent) {
    text += "  or " + name + ", which explains the data equally well\n";
  }
  text += parametersText(cause.parameters);
  if (cause.simulation) text += simulationText(*cause.simulation);
  if (!std::isfinite(cause.confidence) && cause.simulation)
    return cause.advice.empty() ? text : text + "  What to do: " + cause.advice + "\n";
  text += cause.gain ? gainText(*cause.gain, explanation.held_out.size())
                     : "  It does not change predictions, so there is no gain.\n";
  return cause.advice.empty() ? text : text + "  What to do: " + cause.advice + "\n";
}

/// The effects with the best scores, which may help the reader to think of other causes.
std::string triedText(std::vector<TriedEffect> tried, bool held_out) {
  if (tried.empty()) return "";
  std::stable_sort(tried.begin(), tried.end(),
                   [](const TriedEffect& a, const TriedEffect& b) { return a.score > b.score; });
  tried.resize(std::min(tried.size(), kTriedShown));
  Rows rows{{"Best effects that were tried", "score [nats]",
             held_out ? "gain per held-out experiment [nats]" : "gain per experiment [nats]"}};
  for (const TriedEffect& effect : tried) {
    rows.push_back({nameText(effect.name, effect.variant), shortNumber(effect.score),
                    estimateText(effect.held_out_gain, effect.standard_error)});
  }
  return "\n" + textTable(rows);
}

}  // namespace

std::string explanationText(const Explanation& explanation) {
  std::string text =
      explanation.own_simulation ? ownSimulationText(*explanation.own_simulation) : "";
  text += "Verdict: " + nameOf(explanation.verdict);
  text += (explanation.message.empty() ? "" : ": " + explanation.message) + "\n\n";
  text += checksText(explanation);
  for (std::size_t k = 0; k < explanation.causes.size(); ++k) {
    text += causeText(explanation.causes[k], k + 1, explanation);
  }
  if (explanation.verdict != Verdict::none)
    text += triedText(explanation.candidates, !explanation.held_out.empty());
  if (!explanation.warnings.empty()) text += "\n";
  for (const std::string& warning : explanation.warnings) text += "Warning: " + warning + "\n";
  return text;
}

}  // namespace uncertainty_identification
