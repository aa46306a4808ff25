#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/truth.h"
#include "support/core_setup.h"
#include "uncertainty_identification/estimation/estimate.h"

/// Monte Carlo runs of the paper's Example 1 (equations 36, 37): simulated, identified from an
/// automatic start, compared with the truth. Tests run a few, scripts/ many.
namespace uncertainty_identification::test {

/// config/example1_truth.yaml with other numbers of experiments and samples.
Truth example1Truth(int experiments = 100, int samples = 100);

/// config/example1.yaml, one thread.
Configuration example1AtRest();

/// The truth as parameters of the likelihood, noise variance included.
ModelParameters example1Parameters();

/// The values that the paper's Table 1 lists as initial ones.
ModelParameters paperStart();

/// One data set, identified.
struct MonteCarloRun {
  Estimate estimate;      ///< by Identifier, from an automatic start
  double from_truth = 0;  ///< log-likelihood of the optimum reached from the truth
};

/// Simulates Example 1 with this seed and identifies it.
MonteCarloRun example1Run(std::uint64_t seed);

/// The five parameters that Table 1 lists, in its order: b1, a1, c1, d1, sigma^2.
struct TableParameter {
  std::string name;
  double truth = 0;
  std::vector<double> values, errors, robust_errors;  ///< of each run: estimate, standard errors

  double mean() const;
  double deviation() const;  ///< standard deviation of the estimates

  /// Share of the runs whose 95 % interval, value +- 1.96 standard errors, contains the truth.
  double coverage(const std::vector<double>& standard_errors) const;
};

/// Collects the runs' estimates of the five parameters.
std::vector<TableParameter> tableParameters(const std::vector<MonteCarloRun>& runs);

}  // namespace uncertainty_identification::test
