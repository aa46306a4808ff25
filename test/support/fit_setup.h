#pragma once

#include <vector>

#include "explanation/candidates.h"
#include "support/core_setup.h"

/// Fits of known systems, for tests of functions that use fits.
namespace uncertainty_identification::test {

/// The system that simulated some experiments, as a fit of them.
inline Fit fitOfTruth(const dense::Model& truth, const Configuration& configuration,
                      const FitData& data) {
  const auto nominal = makeNominalModel(configuration.nominal_model, 1);
  const auto model = std::make_shared<const ExtendedModel>(
      nominal, ErrorBasis(configuration.error_model), configuration.estimation, Effects(),
      summarise(data.experiments()), data.count());
  return evaluated(model, parametersOf(truth), data);
}

/// Experiments of the paper's Example 1 of unit sample time, with what is made of them.
inline FitData example1Data(const std::vector<Experiment>& experiments) {
  std::vector<Experiment> all = experiments;
  for (Experiment& experiment : all) experiment.sample_time = 1;
  return FitData(std::move(all));
}

}  // namespace uncertainty_identification::test
