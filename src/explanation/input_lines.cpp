#include "explanation/input_lines.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "explanation/spectral_peaks.h"
#include "math/constants.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

double powerAt(const VectorXd& signal, double frequency) {
  std::complex<double> sum = 0;
  for (Index k = 0; k < signal.size(); ++k)
    sum += std::polar(signal[k], frequency * static_cast<double>(k));
  return std::norm(sum);
}

/// Median power on one side of a frequency, beyond the two points over which the window spreads a
/// line; 0 beyond the ends of the spectrum.
double beside(const VectorXd& signal, double frequency, double resolution) {
  constexpr int kNearest = 4, kFarthest = 24;
  std::vector<double> powers;
  for (int k = kNearest; k <= kFarthest; ++k) {
    const double at = frequency + k * resolution;
    if (at > 0 && at < kPi) powers.push_back(powerAt(signal, at));
  }
  if (powers.empty()) return 0;
  const auto middle = powers.begin() + static_cast<std::ptrdiff_t>(powers.size() / 2);
  std::nth_element(powers.begin(), middle, powers.end());
  return *middle;
}

/// Power at the frequency, relative to both sides; 0 where there is no peak.
double prominence(const VectorXd& signal, double frequency) {
  const double resolution = 2 * kPi / static_cast<double>(signal.size());
  const double power = powerAt(signal, frequency);
  if (frequency < 4 * resolution || power < powerAt(signal, frequency - resolution) ||
      power < powerAt(signal, frequency + resolution))
    return 0;
  const double negligible = 1e-9 * signal.squaredNorm() * static_cast<double>(signal.size());
  return power / std::max({beside(signal, frequency, resolution),
                           beside(signal, frequency, -resolution), negligible, 1e-300});
}

}  // namespace

bool mayComeFromInput(double frequency, const std::vector<Experiment>& experiments) {
  constexpr int kHarmonics = 5;
  // Of a random input the ratio is exponentially distributed, with a mean of 1.4.
  constexpr double kLine = 30;
  std::vector<VectorXd> inputs;
  inputs.reserve(experiments.size());
  for (const Experiment& experiment : experiments) inputs.push_back(windowed(experiment.u));
  for (int harmonic = 1; harmonic <= kHarmonics; ++harmonic) {
    const auto with_line = std::count_if(inputs.begin(), inputs.end(), [&](const VectorXd& input) {
      return prominence(input, frequency / harmonic) > kLine;
    });
    if (2 * with_line >= static_cast<std::ptrdiff_t>(inputs.size())) return true;
  }
  return false;
}

}  // namespace uncertainty_identification
