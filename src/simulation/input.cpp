#include "simulation/input.h"

#include <cmath>

#include "math/constants.h"
#include "simulation/chain.h"
#include "simulation/signals.h"

namespace uncertainty_identification {
namespace {

/// A signal that takes a new value from draw() every `hold` samples.
template <class Draw>
Eigen::VectorXd held(int samples, int hold, Draw draw) {
  Eigen::VectorXd signal(samples);
  double value = 0;
  for (int k = 0; k < samples; ++k) {
    if (k % hold == 0) value = draw();
    signal(k) = value;
  }
  return signal;
}

/// Sum of the harmonics 1..tones of the record with random phases. Harmonics are orthogonal over
/// the record, so that the amplitude sqrt(2/tones) gives it unit variance.
Eigen::VectorXd multisine(int samples, int tones, std::mt19937_64& random) {
  std::uniform_real_distribution<double> phase(0, 2 * kPi);
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(samples, 0, samples - 1) / samples;
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(samples);
  for (int j = 1; j <= tones; ++j) sum += (2 * kPi * j * t + phase(random)).cos();
  return std::sqrt(2.0 / tones) * sum;
}

/// The input before its mean and variance are set: zero mean, unit variance.
Eigen::VectorXd standardInput(const InputTruth& input, int samples, std::mt19937_64& random) {
  if (input.kind == InputKind::multisine) return multisine(samples, input.tones, random);
  std::normal_distribution<double> normal;
  std::bernoulli_distribution high(0.5);
  std::uniform_real_distribution<double> level(-std::sqrt(3.0), std::sqrt(3.0));
  return held(samples, input.hold, [&] {
    if (input.kind == InputKind::white_noise) return normal(random);
    return input.kind == InputKind::prbs ? (high(random) ? 1.0 : -1.0) : level(random);
  });
}

/// Stationary first-order noise of unit variance with this time constant [samples].
Eigen::VectorXd wandering(int samples, double time_constant, std::mt19937_64& random) {
  const double pole = std::exp(-1 / time_constant);
  Eigen::VectorXd steps = gaussian(samples, 1, random);
  steps.tail(samples - 1) *= std::sqrt(1 - pole * pole);
  return filtered(Eigen::VectorXd::Ones(1), Eigen::VectorXd::Constant(1, -pole), 0, steps);
}

}  // namespace

Eigen::VectorXd makeInput(const InputTruth& input, int samples, std::mt19937_64& random) {
  const Eigen::VectorXd standard = standardInput(input, samples, random);
  return (input.mean + std::sqrt(input.variance) * standard.array()).matrix();
}

Eigen::VectorXd temperature(int samples, std::mt19937_64 random) {
  const double level = 20 + 5 * gaussian(1, 1, random)(0);
  return (level + 3 * wandering(samples, 100, random).array()).matrix();
}

Eigen::VectorXd secondInput(int samples, std::mt19937_64 random) {
  return wandering(samples, 3, random);
}

}  // namespace uncertainty_identification
