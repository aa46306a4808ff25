#include "identification/structure_error.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "math/constants.h"
#include "math/interruption.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kPerOctave = 8;
constexpr int kHalf = kPerOctave / 2;

/// Angles [rad/sample] from the lowest frequency of `samples` samples to the Nyquist frequency.
VectorXd octaveGrid(int samples) {
  const double octaves = std::log2(samples / 2.0);
  const auto count = static_cast<Index>(octaves * kPerOctave) + 1;
  return VectorXd::NullaryExpr(count, [&](Index k) {
    return kPi * std::exp2(static_cast<double>(k + 1 - count) / kPerOctave);
  });
}

/// Power of the differenced input at the angles.
Eigen::ArrayXd powers(const VectorXd& u, const VectorXd& angles) {
  const Eigen::ArrayXcd turn = angles.unaryExpr([](double x) { return std::polar(1.0, -x); });
  Eigen::ArrayXcd phase = Eigen::ArrayXcd::Ones(angles.size()),
                  sum = Eigen::ArrayXcd::Zero(angles.size());
  for (Index k = 1; k < u.size(); ++k) {
    if (k % 1000 == 0) checkpoint();
    const double change = u[k] - u[k - 1];
    if (change != 0) sum += change * phase;
    phase *= turn;
  }
  return sum.abs2();
}

/// The power of a spectrum in the octave about each angle, over as many frequencies as `samples`
/// samples tell apart there, one at least.
Eigen::ArrayXd octaveSums(const Eigen::ArrayXd& power, const VectorXd& angles, double samples) {
  Eigen::ArrayXd sums(angles.size());
  for (Index k = 0; k < angles.size(); ++k) {
    const Index from = std::max<Index>(k - kHalf, 0), to = std::min(k + kHalf, angles.size() - 1);
    const double width = angles[to] - angles[from];
    sums[k] =
        power.segment(from, to - from + 1).mean() * std::max(1.0, width * samples / (2 * kPi));
  }
  return sums;
}

}  // namespace

StructureError structureErrorOf(const std::vector<Experiment>& experiments,
                                const Estimate& estimate) {
  int longest = 0;
  for (const Experiment& experiment : experiments)
    longest = std::max(longest, experiment.samples());
  const NominalModelEstimate& go = estimate.nominal_model;
  const VectorXd angles = octaveGrid(std::max(longest, 4));
  Eigen::ArrayXd information = Eigen::ArrayXd::Zero(angles.size());
  for (const Experiment& experiment : experiments) {
    const double samples = experiment.samples(), measured = experiment.validSamples();
    if (measured < 2) continue;
    information +=
        octaveSums(powers(experiment.u, angles), angles, samples) * measured / (samples * samples);
  }
  const VectorXd a = withLeadingOne(go.a), c = withLeadingOne(go.c), d = withLeadingOne(go.d);
  StructureError error{angles / go.sample_time, VectorXd(angles.size())};
  for (Index k = 0; k < angles.size(); ++k) {
    const std::complex<double> z = std::polar(1.0, -angles[k]);
    const double noise =
        estimate.noise_variance.value * std::norm((1.0 - z) * valueAt(c, z) / valueAt(d, z));
    const double response = std::norm(valueAt(go.b, z) / valueAt(a, z));
    error.relative[k] = std::sqrt(noise / std::max(response * information[k], 1e-300));
  }
  return error;
}

}  // namespace uncertainty_identification
