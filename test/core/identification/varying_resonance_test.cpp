// Plants whose resonance varies by more than its width: no plant simulates all of them well. They
// are simulated here, exactly, and not by the package.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

constexpr double kPeriod = 0.1, kOmega = 6, kZeta = 0.06, kNoise = 0.02, kSpread = 0.09;

/// omega^2/(s^2 + 2 zeta omega s + omega^2) behind a zero-order hold, from rest.
Experiment run(int number, double omega, std::mt19937_64* engine) {
  std::normal_distribution<double> normal;
  const double damped = std::sqrt(1 - kZeta * kZeta), decay = std::exp(-kZeta * omega * kPeriod),
               cosine = decay * std::cos(damped * omega * kPeriod),
               sine = decay * std::sin(damped * omega * kPeriod) * kZeta / damped;
  const double a1 = -2 * cosine, a2 = decay * decay, b1 = 1 - cosine - sine,
               b2 = a2 + sine - cosine;
  Experiment one;
  one.id = "run_" + std::to_string(number);
  one.sample_time = kPeriod;
  one.u.resize(100);
  one.y.resize(100);
  double y1 = 0, y2 = 0, u1 = 0, u2 = 0, level = 0;
  for (int t = 0; t < 100; ++t) {
    if (t % 4 == 0) level = normal(*engine);
    const double y = b1 * u1 + b2 * u2 - a1 * y1 - a2 * y2;
    one.u[t] = level;
    one.y[t] = y + kNoise * normal(*engine);
    y2 = std::exchange(y1, y);
    u2 = std::exchange(u1, level);
  }
  return one;
}

TEST(VaryingResonance, IsFoundThoughADampedPlantSimulatesAllBetter) {
  for (const unsigned seed : {1u, 2u}) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<Experiment> runs;
    for (int r = 0; r < 20; ++r)
      runs.push_back(run(r, kOmega * (1 + kSpread * normal(engine)), &engine));
    const Estimate found = Identifier(Configuration()).identify(runs);
    const ErrorModelOptions& error_model = found.configuration.error_model;
    EXPECT_EQ(error_model.basis, BasisKind::parameter_spread) << "seed " << seed;
    const auto omega = std::find(error_model.parameters.begin(), error_model.parameters.end(),
                                 std::string("omega1"));
    ASSERT_NE(omega, error_model.parameters.end()) << "seed " << seed;
    const Eigen::Index k = omega - error_model.parameters.begin();
    // The standard deviation of 20 draws has a relative standard error of 16 %; four of them.
    const double deviation = std::sqrt(found.error_model.mixture.covariance()(k, k));
    EXPECT_NEAR(deviation, kSpread, 4 * 0.16 * kSpread) << "seed " << seed;
  }
}

}  // namespace
}  // namespace uncertainty_identification
