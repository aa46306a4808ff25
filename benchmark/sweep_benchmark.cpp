#include <benchmark/benchmark.h>

#include "simulation/simulate.h"
#include "support/monte_carlo.h"

/// One sweep over all samples, statistics with their derivatives, for Example 1's structure: what a
/// pass of the optimisation costs. Arguments: experiments M, samples N.
namespace uncertainty_identification::test {
namespace {

void countSamples(benchmark::State& state) {
  state.counters["per_sample"] = benchmark::Counter(
      static_cast<double>(state.range(0)) * static_cast<double>(state.range(1)),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// One thread. The default configuration takes the general path, an arrangement of filters.
void sweep(benchmark::State& state, const Configuration& configuration) {
  const auto experiments = static_cast<int>(state.range(0)),
             samples = static_cast<int>(state.range(1));
  const CoreSetup setup(configuration, simulate(example1Truth(experiments, samples), 1));
  Eigen::VectorXd at = example1Parameters().parameters;
  if (configuration.estimation.offsets == Offsets::estimate) at = appended(at, 0.0);
  for (auto _ : state) {
    const Statistics statistics = setup.likelihood().statistics(at, true);
    benchmark::DoNotOptimize(statistics.samples().data());
  }
  countSamples(state);
}

void atRest(benchmark::State& state) { sweep(state, example1AtRest()); }

void defaultNuisances(benchmark::State& state) {
  Configuration configuration = example1AtRest();
  configuration.estimation = EstimationOptions();
  sweep(state, configuration);
}

/// Reading u and y alone: what the machine's memory grants at most.
void reading(benchmark::State& state) {
  const auto experiments = static_cast<int>(state.range(0));
  const auto samples = static_cast<int>(state.range(1));
  const auto data = simulate(example1Truth(experiments, samples), 1);
  const std::vector<Block> blocks = makeBlocks(data);
  for (auto _ : state) {
    double sum = 0;
    for (const Block& block : blocks) sum += block.u.sum() + block.y.sum();
    benchmark::DoNotOptimize(sum);
  }
  countSamples(state);
}

BENCHMARK(atRest)->Args({100, 100})->Args({1000, 100})->Args({100000, 100})->Args({100, 10000});
BENCHMARK(reading)->Args({100, 100})->Args({100000, 100});
BENCHMARK(defaultNuisances)->Args({100, 100})->Args({1000, 100});

}  // namespace
}  // namespace uncertainty_identification::test

BENCHMARK_MAIN();
