// One record, of which a part is held out.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "curves/explain_simulation.h"

namespace uncertainty_identification {
namespace {

/// A staircase of the input whose highest level rises from 0 to 1 over the record, and the answer
/// of a lag to the input up to `limit`, in noise of 0.01.
Experiment risingStaircase(double limit, unsigned seed) {
  constexpr int kSamples = 1200, kStair = 20;
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Experiment experiment;
  experiment.id = "staircase";
  experiment.sample_time = 0.1;
  experiment.u.resize(kSamples);
  experiment.y.resize(kSamples);
  double x = 0, level = 0;
  for (int k = 0; k < kSamples; ++k) {
    if (k % kStair == 0) level = (0.3 + 0.7 * uniform(engine)) * k / kSamples;
    experiment.u[k] = level;
    experiment.y[k] = 2 * x + 0.01 * normal(engine);
    x += 0.2 * (std::min(level, limit) - x);
  }
  return experiment;
}

SimulationCauses explained(const Experiment& experiment) {
  WorkerPool pool(1);
  return explainSimulation({experiment}, {}, {}, &pool);
}

// Were the last third held out, no window that is fitted to would show the limit.
TEST(RisingLevels, AreHeldOutAsWellAsFittedTo) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const SimulationCauses limited = explained(risingStaircase(0.65, seed));
    ASSERT_EQ(limited.causes.size(), 1u) << seed;
    EXPECT_EQ(limited.causes[0].what.name, "act_saturation") << seed;
    EXPECT_GT(limited.fit_after, 90) << seed;
    EXPECT_TRUE(explained(risingStaircase(100, seed)).causes.empty()) << seed;
  }
}

}  // namespace
}  // namespace uncertainty_identification
