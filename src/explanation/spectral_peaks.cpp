#include "explanation/spectral_peaks.h"

#include <cmath>

#include "math/constants.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

constexpr int kRefinement = 4;            // points per resolved line of the spectrum
constexpr int kLowest = 2 * kRefinement;  // points below it are left out: the window's mean

/// Power at `points` frequencies up to the Nyquist frequency, by Goertzel's recursion.
ArrayXd spectrum(const VectorXd& signal, int points) {
  ArrayXd power(points);
  for (int i = 0; i < points; ++i) {
    const double turn = 2 * std::cos(kPi * i / points);
    double now = 0, before = 0;
    for (Index t = 0; t < signal.size(); ++t) {
      const double next = signal[t] + turn * now - before;
      before = now;
      now = next;
    }
    power[i] = now * now + before * before - turn * now * before;
  }
  return power;
}

/// Frequency of the largest peak [rad/sample].
double peakOf(const ArrayXd& power) {
  Index at = 0;
  power.tail(power.size() - kLowest).maxCoeff(&at);
  return kPi * static_cast<double>(at + kLowest) / static_cast<double>(power.size());
}

}  // namespace

VectorXd windowed(VectorXd signal) {
  const auto length = static_cast<double>(signal.size());
  signal.array() -= signal.mean();
  for (Index t = 0; t < signal.size(); ++t)
    signal[t] *= 0.5 - 0.5 * std::cos(2 * kPi * (static_cast<double>(t) + 0.5) / length);
  return signal;
}

void findSpectralPeaks(const Residuals& residuals, const FitData& data, DataSummary* summary) {
  constexpr int kMostSpectra = 12, kMostSamples = 2000;
  const int samples = std::min(summary->samples, kMostSamples), points = kRefinement * samples / 2;
  if (points <= kLowest) return;
  ArrayXd own = ArrayXd::Zero(points);
  VectorXd mean = VectorXd::Zero(samples);
  int spectra = 0;
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    const Block& block = data.blocks()[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      const Index length = std::min(block.lengths[static_cast<std::size_t>(lane)], samples);
      const VectorXd signal =
          windowed(residuals.standardised[b].row(lane).head(length).transpose().matrix());
      mean.head(length) += signal;
      if (spectra++ < kMostSpectra) own += spectrum(signal, points);
    }
  }
  summary->common_peak = peakOf(spectrum(mean, points));
  summary->own_peak = peakOf(own);
}

}  // namespace uncertainty_identification
