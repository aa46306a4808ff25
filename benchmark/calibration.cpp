#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "support/monte_carlo.h"

/// Checks the calibration of the standard errors: the share of Monte Carlo runs of Example 1 whose
/// 95 % intervals contain the truth. Argument: number of runs (1000). Exits with 1 if a share for
/// the observed information is outside [92.5 %, 97 %] or a run did not converge.
namespace uncertainty_identification::test {
namespace {

int calibrate(int count) {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<MonteCarloRun> runs;
  int unfinished = 0, below = 0;
  for (int k = 1; k <= count; ++k) {
    runs.push_back(example1Run(1000 + static_cast<std::uint64_t>(k)));
    const Estimate& estimate = runs.back().estimate;
    if (estimate.termination != Termination::converged) ++unfinished;
    if (estimate.log_likelihood < runs.back().from_truth - 1e-4) ++below;
  }
  const std::chrono::duration<double, std::ratio<60>> minutes =
      std::chrono::steady_clock::now() - begin;
  std::printf(
      "%d runs of Example 1 in %.1f minutes; %d did not converge; %d ended below the\n"
      "optimum reached from the truth\n\n%-8s %16s %16s %16s %16s\n",
      count, minutes.count(), unfinished, below, "", "std. deviation", "mean std. error",
      "coverage", "robust coverage");
  int outside = 0;
  for (const TableParameter& parameter : tableParameters(runs)) {
    const double coverage = parameter.coverage(parameter.errors);
    double error = 0;
    for (double one : parameter.errors) error += one / count;
    if (!(coverage >= 0.925 && coverage <= 0.97)) ++outside;
    std::printf("%-8s %16.3e %16.3e %16.3f %16.3f\n", parameter.name.c_str(), parameter.deviation(),
                error, coverage, parameter.coverage(parameter.robust_errors));
  }
  std::printf("\n%s\n", outside + unfinished == 0 ? "passed" : "FAILED");
  return outside + unfinished == 0 ? 0 : 1;
}

}  // namespace
}  // namespace uncertainty_identification::test

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 1000;
  if (count < 2) {
    std::fprintf(stderr, "usage: calibration [runs, at least 2]\n");
    return 2;
  }
  return uncertainty_identification::test::calibrate(count);
}
