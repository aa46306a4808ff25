// Measures how long it takes to compute the bounds of Example 1: 500 frequencies, 4 levels, M =
// 100, one thread.
#include <benchmark/benchmark.h>

#include "bounds/frequency_grid.h"
#include "support/monte_carlo.h"
#include "uncertainty_identification/bounds/bounds.h"

namespace uncertainty_identification::test {
namespace {

const Estimate& estimate() {
  static const Estimate kEstimate = example1Run(1).estimate;
  return kEstimate;
}

void frequency(benchmark::State& state) {
  const PlantDistribution plants(estimate());
  const Eigen::VectorXd omega =
      frequencyGrid(estimate().nominal_model, static_cast<int>(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(frequencyBounds(plants, omega, BoundsOptions(), 1).omega.sum());
}
BENCHMARK(frequency)->Arg(100)->Arg(500)->Arg(2000)->Unit(benchmark::kMillisecond);

void step(benchmark::State& state) {
  const PlantDistribution plants(estimate());
  for (auto _ : state)
    benchmark::DoNotOptimize(stepBounds(plants, BoundsOptions(), 1).nominal.sum());
}
BENCHMARK(step)->Unit(benchmark::kMillisecond);

void weight(benchmark::State& state) {
  const PlantDistribution plants(estimate());
  const Eigen::VectorXd omega = frequencyGrid(estimate().nominal_model, 500);
  for (auto _ : state)
    benchmark::DoNotOptimize(uncertaintyWeight(plants, omega, BoundsOptions(), 1).margin);
}
BENCHMARK(weight)->Unit(benchmark::kMillisecond);

void all(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(computeBounds(estimate()).seconds);
}
BENCHMARK(all)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace uncertainty_identification::test

BENCHMARK_MAIN();
