#include "uncertainty_identification/io/result_json.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "io/baseline_binding.h"
#include "io/bounds_json.h"
#include "io/estimate_binding.h"
#include "io/json_file.h"
#include "io/result_binding.h"
#include "io/result_checks.h"
#include "io/tree_reader.h"
#include "io/tree_writer.h"

namespace uncertainty_identification {

nlohmann::json toJson(const Estimate& estimate) {
  Estimate copy = estimate;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (copy.validation.experiments.empty()) copy.validation = {{}, {}, kNone, kNone};
  if (copy.residual_tests.autocorrelation.empty()) copy.residual_tests = {0, {}, {}, kNone, kNone};
  nlohmann::json tree = writtenTree(std::move(copy));
  tree["bounds"] = nlohmann::json::object();
  return tree;
}

namespace {

Estimate consistentEstimate(const nlohmann::json& json) {
  Estimate estimate = readRecord<Estimate>(json);
  estimate.configuration.validate();
  ErrorModelOptions& options = estimate.error_model.options;
  if (options.constraint != Constraint::explicit_matrix) options.T.resize(0, 0);
  if (estimate.validation.experiments.empty()) estimate.validation = {};
  if (estimate.residual_tests.autocorrelation.empty()) estimate.residual_tests = {};
  requireConsistent(estimate);
  return estimate;
}

}  // namespace

Estimate estimateFromJson(const nlohmann::json& json) {
  Estimate estimate = consistentEstimate(json);
  requireStableNoise(estimate.nominal_model);
  return estimate;
}

namespace {

/// The signals are there to be drawn: five digits are enough.
nlohmann::json runsToJson(const std::vector<SimulatedRun>& runs) {
  nlohmann::json list = nlohmann::json::array();
  for (const SimulatedRun& run : runs) {
    nlohmann::json tree = writtenTree(run);
    for (const char* key : {"measured", "simulated", "lower", "upper"}) roundNumbers(&tree[key], 5);
    list.push_back(std::move(tree));
  }
  return list;
}

/// What the result holds beside the estimate; a key that results of older versions lack stays away.
Result restOf(const nlohmann::json& tree) {
  Result result;
  if (tree.contains("baseline")) result.baseline = readRecord<Baseline>(tree["baseline"]);
  if (tree.contains("bounds") && !tree["bounds"].empty())
    result.bounds = boundsFromJson(tree["bounds"]);
  if (tree.contains("physical")) result.physical = readRecord<PhysicalNumbers>(tree["physical"]);
  if (tree.contains("origin")) result.origin = readRecord<Origin>(tree["origin"]);
  if (tree.contains("runs")) {
    for (const nlohmann::json& run : tree["runs"])
      result.runs.push_back(readRecord<SimulatedRun>(run));
  }
  return result;
}

}  // namespace

nlohmann::json toJson(const Result& result) {
  nlohmann::json tree = toJson(result.estimate);
  if (result.bounds) tree["bounds"] = toJson(*result.bounds);
  if (result.baseline) tree["baseline"] = writtenTree(*result.baseline);
  tree["physical"] = writtenTree(result.physical);
  tree["runs"] = runsToJson(result.runs);
  tree["origin"] = writtenTree(result.origin);
  return tree;
}

void saveResult(const std::string& path, const Result& result) { saveJson(path, toJson(result)); }

Result loadResult(const std::string& path) {
  return loadJsonAs(path, [](const nlohmann::json& tree) {
    Result result = restOf(tree);
    result.estimate = result.baseline ? consistentEstimate(tree) : estimateFromJson(tree);
    return result;
  });
}

}  // namespace uncertainty_identification
