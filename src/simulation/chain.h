#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

#include "math/random_stream.h"
#include "simulation/simulate.h"

/// The stations that a signal passes between the input and the record of one experiment.
namespace uncertainty_identification {

/// What the stations know besides the signal.
struct ChainContext {
  const Truth& truth;
  const DrawnSystem& system;
  const Experiment& experiment;  ///< covariates and stamp offsets; u and y may still be absent
  std::uint64_t seed;
  int r;

  std::mt19937_64 stream(RandomPurpose purpose) const { return randomStream(seed, r, purpose); }
};

/// The covariate `temp`, and `d`.
Eigen::VectorXd temperature(int samples, std::mt19937_64 random);
Eigen::VectorXd secondInput(int samples, std::mt19937_64 random);

/// x: the noise-free output of actuator and plant, Go (1 + GDelta) u from rest, equation (2), with
/// all effects up to there.
Eigen::VectorXd plantOutput(const ChainContext& context, const Eigen::VectorXd& u);

/// x at the instants at which it is sampled.
Eigen::VectorXd sampledOutput(const ChainContext& context, const Eigen::VectorXd& x);

/// v = C/D w for the recorded input u and output x, which the variance of w may depend on.
Eigen::VectorXd outputNoise(const ChainContext& context, const Eigen::VectorXd& u,
                            const Eigen::VectorXd& x);

/// y: what the sensor makes of x and the noise v.
Eigen::VectorXd measured(const ChainContext& context, const Eigen::VectorXd& x,
                         const Eigen::VectorXd& v);

}  // namespace uncertainty_identification
