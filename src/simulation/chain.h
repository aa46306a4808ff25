#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

#include "math/random_stream.h"
#include "simulation/simulate.h"

/// The stages that a signal passes from the input to the record of one experiment.
namespace uncertainty_identification {

/// What every stage is given besides the signal.
struct ChainContext {
  const Truth& truth;
  const DrawnSystem& system;
  const Experiment& experiment;  ///< its covariates and time stamps; u and y may not be there yet
  std::uint64_t seed;
  int r;

  std::mt19937_64 stream(RandomPurpose purpose) const { return randomStream(seed, r, purpose); }
};

/// The covariates `temp` and `d` of CovariatesTruth.
Eigen::VectorXd temperature(int samples, std::mt19937_64 random);
Eigen::VectorXd secondInput(int samples, std::mt19937_64 random);

/// The noise-free output x of actuator and plant, with their effects: Go (1 + GDelta) u from rest,
/// equation (2).
Eigen::VectorXd plantOutput(const ChainContext& context, const Eigen::VectorXd& u);

/// x at the times at which it is really sampled, which exp_clock and exp_jitter change.
Eigen::VectorXd sampledOutput(const ChainContext& context, const Eigen::VectorXd& x);

/// The noise v = C/D w. With noise_hetero the variance of w depends on the input u or the output x.
Eigen::VectorXd outputNoise(const ChainContext& context, const Eigen::VectorXd& u,
                            const Eigen::VectorXd& x);

/// The measured output y: the output x and the noise v, with the effects of the sensor.
Eigen::VectorXd measured(const ChainContext& context, const Eigen::VectorXd& x,
                         const Eigen::VectorXd& v);

}  // namespace uncertainty_identification
