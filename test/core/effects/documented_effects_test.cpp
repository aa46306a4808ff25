// The table of effects in docs/explanation.md against the catalogue.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

/// Data with a covariate and a parameter called as in the table, a first-order plant and one error
/// parameter.
Effects documented() {
  DataSummary data;
  data.experiments = 10;
  data.samples = 100;
  data.regressors = 1;
  data.covariates = {{"COVARIATE", 0}};
  data.stamps = true;
  data.plant_parameters = {"PARAMETER", "a1"};
  return catalogue(data);
}

/// Name, variant, meaning and parameters of an effect as the table's first columns have them.
std::string rowOf(const EffectDescription& of) {
  std::string row = "| `" + of.name + "` | " + of.variant + " | " + of.meaning + " | ";
  std::string parameters;
  for (const EffectParameter& parameter : of.parameters)
    parameters += (parameters.empty() ? "" : ", ") + parameter.name + " [" + parameter.unit + "]";
  return row + parameters + " |";
}

/// What precedes the definition in each row of the table.
std::vector<std::string> rowsOfTheTable() {
  std::ifstream in(std::string(PROJECT_FOLDER) + "/docs/explanation.md");
  std::vector<std::string> rows;
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("## ", 0) == 0) inside = line == "## The effects";
    if (!inside || line.rfind("| `", 0) != 0) continue;
    const std::size_t definition = line.rfind(" | ");
    EXPECT_GT(line.size(), definition + 5) << "no definition: " << line;
    rows.push_back(line.substr(0, definition + 2));
  }
  return rows;
}

TEST(DocumentedEffects, AreThoseOfTheCatalogueInItsOrder) {
  std::vector<std::string> expected;
  for (const auto& effect : documented()) {
    if (effect->description().variant != "a1")  // PARAMETER stands for it
      expected.push_back(rowOf(effect->description()));
  }
  EXPECT_EQ(rowsOfTheTable(), expected);
}

}  // namespace
}  // namespace uncertainty_identification
