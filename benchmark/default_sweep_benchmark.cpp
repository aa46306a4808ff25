#include <benchmark/benchmark.h>

#include "simulation/simulate.h"
#include "support/monte_carlo.h"

/// One pass over all samples, statistics with their derivatives, for Example 1's structure with the
/// default options (noise present before the first sample, unknown initial state, an offset), and
/// beside it with everything at rest. Arguments: experiments M, samples N. One thread.
namespace uncertainty_identification::test {
namespace {

enum class Options { at_rest, defaults, own_offsets };

Configuration configurationFor(Options options) {
  Configuration configuration = example1AtRest();
  if (options == Options::at_rest) return configuration;
  configuration.estimation = EstimationOptions();
  configuration.estimation.initial_precision = 1e-3;
  if (options == Options::own_offsets) configuration.estimation.offsets = Offsets::per_experiment;
  return configuration;
}

struct Problem {
  Problem(const benchmark::State& state, Options options)
      : setup(configurationFor(options), simulate(example1Truth(static_cast<int>(state.range(0)),
                                                                static_cast<int>(state.range(1))),
                                                  1)),
        at(example1Parameters().parameters) {
    if (options == Options::defaults) at = appended(at, 0.1);
  }
  CoreSetup setup;
  Eigen::VectorXd at;
};

void countSamples(benchmark::State& state) {
  state.counters["per_sample"] = benchmark::Counter(
      static_cast<double>(state.range(0)) * static_cast<double>(state.range(1)),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void sweep(benchmark::State& state, Options options) {
  const Problem problem(state, options);
  for (auto _ : state) {
    const Statistics statistics = problem.setup.likelihood().statistics(problem.at, true);
    benchmark::DoNotOptimize(statistics.samples().data());
  }
  countSamples(state);
}

/// What a scoring step needs beside the statistics.
void information(benchmark::State& state, Options options) {
  const Problem problem(state, options);
  const Likelihood& likelihood = problem.setup.likelihood();
  ModelParameters at = example1Parameters();
  at.parameters = problem.at;
  const LatentMoments moments =
      latentMoments(likelihood.expect(likelihood.statistics(at.parameters, true), at));
  for (auto _ : state) {
    const ScoringInformation information = likelihood.information(at, moments);
    benchmark::DoNotOptimize(information.complete.data());
  }
  countSamples(state);
}

void sizes(benchmark::internal::Benchmark* of) {
  of->Args({100, 100})->Args({1000, 100})->Args({100, 1000})->Args({100, 10000})->Args({30, 300});
}

BENCHMARK_CAPTURE(sweep, at_rest, Options::at_rest)->Apply(sizes);
BENCHMARK_CAPTURE(sweep, defaults, Options::defaults)->Apply(sizes);
BENCHMARK_CAPTURE(sweep, own_offsets, Options::own_offsets)->Apply(sizes);
BENCHMARK_CAPTURE(information, at_rest, Options::at_rest)->Apply(sizes);
BENCHMARK_CAPTURE(information, defaults, Options::defaults)->Apply(sizes);

}  // namespace
}  // namespace uncertainty_identification::test

BENCHMARK_MAIN();
