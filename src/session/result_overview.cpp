#include "session/result_overview.h"

#include <limits>

#include "uncertainty_identification/bounds/plant_distribution.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// With intervals and spread where the plants have a distribution.
PhysicalNumbers numbersOf(const Estimate& estimate) {
  try {
    const PlantDistribution plants(estimate);
    return physicalNumbers(estimate, &plants);
  } catch (const Error&) {
    return physicalNumbers(estimate, nullptr);
  }
}

}  // namespace

void addOverview(const std::vector<KeptExperiment>& kept, Result* result) {
  std::vector<Experiment> experiments;
  for (const KeptExperiment& one : kept) experiments.push_back(*one.experiment);
  result->physical = numbersOf(result->estimate);
  result->runs = simulatedRuns(result->estimate, nullptr, experiments, {});
}

std::optional<PhysicalNumber> findNumber(const PhysicalNumbers& physical, const std::string& name) {
  for (const PhysicalNumber& number : physical.numbers) {
    if (number.name == name || number.name == name + "_1") return number;
  }
  return std::nullopt;
}

double typicalFit(const std::vector<SimulatedRun>& runs) {
  for (const SimulatedRun& run : runs) {
    if (run.rank == "median") return run.fit_percent;
  }
  return runs.empty() ? std::numeric_limits<double>::quiet_NaN() : runs.front().fit_percent;
}

}  // namespace uncertainty_identification
