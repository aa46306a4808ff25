#include "io/own_simulation_text.h"

#include <cmath>
#include <cstdio>
#include <vector>

#include "io/text_table.h"

namespace uncertainty_identification {
namespace {

std::string fourDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return std::isfinite(value) ? text : "-";
}

std::vector<std::string> rowOf(const OwnCause& cause, const OwnValue& value) {
  const bool known = std::isfinite(value.standard_error);
  return {value.name + (value.unit.empty() || value.unit == "1" ? "" : " [" + value.unit + "]"),
          fourDigits(value.yours),
          estimateText(value.measured, value.standard_error),
          known ? fourDigits(value.lower_95) + " to " + fourDigits(value.upper_95) : "-",
          std::isfinite(cause.t) ? "t = " + fourDigits(cause.t) : "-",
          fourDigits(cause.fit_without) + " %"};
}

/// The curves that it lacks.
std::string curvesText(const OwnSimulationFindings& findings) {
  const SimulationCauses& structure = findings.structure;
  std::string text;
  if (!structure.skipped.empty()) text += "\nAbout curves: " + structure.skipped + ".\n";
  for (const SimulationCause& cause : structure.causes) {
    text += "\n" + cause.what.name + ": " + cause.description + "\n";
    for (const ShapeValue& value : cause.values)
      text += "  " + value.name + " " + estimateText(value.value, value.standard_error) + "\n";
    text += "  What to do: " + cause.advice + "\n";
  }
  return text;
}

/// The causes other than curves.
std::string changesText(const OwnSimulationFindings& findings) {
  const bool leads = findings.curveLeads();
  std::vector<std::vector<std::string>> rows{
      {leads ? "Best without the curve" : "What is wrong with it", "yours", "measured",
       "95 % interval", "significance", "fit without this"}};
  for (const OwnCause& cause : findings.causes)
    for (const OwnValue& value : cause.values) rows.push_back(rowOf(cause, value));
  std::string text;
  if (rows.size() > 1) text += "\n" + textTable(rows);
  if (leads && rows.size() > 1)
    return text +
           "These values may only stand for the curve: mend the curve first, and compare again.\n";
  for (const OwnCause& cause : findings.causes) {
    text += "\n" + cause.name + (cause.parameter.empty() ? "" : " (" + cause.parameter + ")") +
            ": " + cause.description + (cause.remark.empty() ? "" : "; " + cause.remark) + "\n";
    for (const std::string& tie : cause.ties) text += "  or " + tie + ": the data cannot tell\n";
    text += "  What to do: " + cause.advice + "\n";
  }
  return text;
}

}  // namespace

std::string ownSimulationText(const OwnSimulationFindings& findings) {
  std::string text = findings.sentence + ".\n";
  const bool curve_first = findings.has_curve_around || findings.curveLeads();
  text += curve_first ? curvesText(findings) + changesText(findings)
                      : changesText(findings) + curvesText(findings);
  text += "\nThis is " + findings.simulation + ", run " + std::to_string(findings.simulations) +
          (findings.simulations == 1 ? " time" : " times") +
          (findings.can_rerun ? "" : " (a logged signal cannot be run with other values)") +
          (findings.ended_early ? "; the search ended early (simulation.max_simulations)" : "") +
          ".\n\nBeside your simulation, a model identified from the same data:\n";
  return text;
}

}  // namespace uncertainty_identification
