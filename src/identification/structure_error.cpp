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

/// Whether a smooth input is cut off where these changes begin: many samples change it, and so do
/// the first ones.
bool isCutOff(const Eigen::ArrayXd& changes) {
  constexpr double kSmall = 0.1, kFew = 0.25;
  const Eigen::Index fewest = 2;
  const Eigen::ArrayXd size = changes.abs();
  const double small = kSmall * size.maxCoeff();
  const auto large = static_cast<double>((size > small).count());
  const bool moves = size.head(std::min(fewest, size.size())).maxCoeff() > small;
  return moves && large >= std::max<double>(fewest, kFew * static_cast<double>(size.size()));
}

/// The changes of the input. A smooth input that is cut off at an end would seem to have power at
/// high frequencies, so that a quarter of the record is faded out there; steps have this power
/// wherever they are. Scaled to the same power of an input that is random.
Eigen::ArrayXd changesOf(const VectorXd& u) {
  constexpr double kOfFading = 0.375;  // its mean power
  const Index count = u.size() - 1, end = count / 4;
  Eigen::ArrayXd changes = u.tail(count) - u.head(count);
  if (end == 0) return changes;
  const Eigen::ArrayXd fading = Eigen::ArrayXd::NullaryExpr(end, [&](Index k) {
    return (1 - std::cos(kPi * (static_cast<double>(k) + 0.5) / static_cast<double>(end))) / 2;
  });
  const bool at_begin = isCutOff(changes.head(end)), at_end = isCutOff(changes.tail(end).reverse());
  if (at_begin) changes.head(end) *= fading;
  if (at_end) changes.tail(end) *= fading.reverse();
  const double faded = static_cast<double>(end) / static_cast<double>(count) *
                       static_cast<double>(at_begin + at_end);
  return changes / std::sqrt(1 - faded * (1 - kOfFading));
}

/// Power of the differenced input at the angles.
Eigen::ArrayXd powers(const VectorXd& u, const VectorXd& angles) {
  const Eigen::ArrayXcd turn = angles.unaryExpr([](double x) { return std::polar(1.0, -x); });
  Eigen::ArrayXcd phase = Eigen::ArrayXcd::Ones(angles.size()),
                  sum = Eigen::ArrayXcd::Zero(angles.size());
  const Eigen::ArrayXd changes = changesOf(u);
  for (Index k = 0; k < changes.size(); ++k) {
    if (k % 1000 == 999) checkpoint();
    if (changes[k] != 0) sum += changes[k] * phase;
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
    if (measured < 2 || samples < 2) continue;
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
