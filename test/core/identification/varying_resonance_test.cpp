// Plants whose resonance varies by more than its width: no plant simulates all of them well. They
// are simulated here, exactly, and not by the package.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "model/modal.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

constexpr double kInterval = 0.1, kOmega = 6, kZeta = 0.06, kSensorNoise = 0.02, kSpread = 0.09;

/// omega^2/(s^2 + 2 zeta omega s + omega^2) behind a zero-order hold, from rest.
Experiment run(int number, double omega, std::mt19937_64* engine) {
  std::normal_distribution<double> normal;
  const double damped = std::sqrt(1 - kZeta * kZeta), decay = std::exp(-kZeta * omega * kInterval),
               cosine = decay * std::cos(damped * omega * kInterval),
               sine = decay * std::sin(damped * omega * kInterval) * kZeta / damped;
  const double a1 = -2 * cosine, a2 = decay * decay, b1 = 1 - cosine - sine,
               b2 = a2 + sine - cosine;
  Experiment one;
  one.id = "run_" + std::to_string(number);
  one.sample_time = kInterval;
  one.u.resize(100);
  one.y.resize(100);
  double y1 = 0, y2 = 0, u1 = 0, u2 = 0, level = 0;
  for (int t = 0; t < 100; ++t) {
    if (t % 4 == 0) level = normal(*engine);
    const double y = b1 * u1 + b2 * u2 - a1 * y1 - a2 * y2;
    one.u[t] = level;
    one.y[t] = y + kSensorNoise * normal(*engine);
    y2 = std::exchange(y1, y);
    u2 = std::exchange(u1, level);
  }
  return one;
}

/// Relative standard deviation of the resonance frequency: it is a parameter, or moves with the
/// factors of a mode; 0 where it does not vary.
double deviationOfOmega(const Estimate& found) {
  const std::vector<std::string>& varied = found.configuration.error_model.parameters;
  const Eigen::MatrixXd covariance = found.error_model.mixture.covariance();
  const auto omega = std::find(varied.begin(), varied.end(), std::string("omega1"));
  if (omega != varied.end()) {
    const Eigen::Index k = omega - varied.begin();
    return std::sqrt(covariance(k, k));
  }
  const std::vector<ParameterEstimate>& parameters = found.nominal_model.parameters;
  Eigen::VectorXd theta(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k)
    theta[static_cast<Eigen::Index>(k)] = parameters[k].value;
  const ModalParameters modes =
      modalParameters(found.configuration.nominal_model, found.nominal_model.sample_time, theta);
  const auto name = std::find(modes.names.begin(), modes.names.end(), "omega1");
  if (name == modes.names.end()) return 0;
  const Eigen::Index n = covariance.rows(), k = name - modes.names.begin();
  const Eigen::RowVectorXd by_xi = modes.by_theta.row(k).head(n) * theta.head(n).asDiagonal();
  return std::sqrt((by_xi * covariance * by_xi.transpose()).value()) / modes.values[k];
}

TEST(VaryingResonance, IsFoundThoughADampedPlantSimulatesAllBetter) {
  for (const unsigned seed : {1u, 2u}) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<Experiment> runs;
    for (int r = 0; r < 20; ++r)
      runs.push_back(run(r, kOmega * (1 + kSpread * normal(engine)), &engine));
    const Estimate found = Identifier(Configuration()).identify(runs);
    EXPECT_EQ(found.configuration.error_model.basis, BasisKind::parameter_spread)
        << "seed " << seed;
    // The standard deviation of 20 draws has a relative standard error of 16 %; four of them.
    EXPECT_NEAR(deviationOfOmega(found), kSpread, 4 * 0.16 * kSpread) << "seed " << seed;
  }
}

}  // namespace
}  // namespace uncertainty_identification
