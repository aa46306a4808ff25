#include "data/thinning.h"

#include <algorithm>
#include <cmath>

#include "data/bandwidth.h"
#include "data/bridged_output.h"
#include "math/median.h"

namespace uncertainty_identification {
namespace {

constexpr double kFewestSamples = 2500;

/// Means of `thinning` samples each.
Eigen::VectorXd averaged(const Eigen::VectorXd& signal, int thinning) {
  if (thinning == 1) return signal;
  const Eigen::Index length = signal.size() / thinning;
  Eigen::VectorXd means(length);
  for (Eigen::Index k = 0; k < length; ++k)
    means[k] = signal.segment(k * thinning, thinning).mean();
  return means;
}

}  // namespace

int thinningByBandwidth(const std::vector<Experiment>& experiments, double per_period) {
  double samples = 0;
  std::vector<double> widths;
  for (const Experiment& experiment : experiments) {
    samples += experiment.samples();
    if (experiment.samples() >= 8) widths.push_back(bandwidth(bridgedOutput(experiment)));
  }
  if (widths.empty()) return 1;
  const double by_bandwidth = 1 / (per_period * std::max(medianOf(widths), 1e-9));
  return std::max(1, static_cast<int>(std::min(by_bandwidth, samples / kFewestSamples) + 1e-9));
}

Experiment thinned(const Experiment& experiment, int thinning) {
  if (thinning <= 1) return experiment;
  Experiment kept = experiment;
  kept.sample_time *= thinning;
  kept.u = averaged(experiment.u, thinning);
  for (auto& [name, signal] : kept.signals) signal = averaged(signal, thinning);
  const Eigen::Index samples = kept.u.size();
  kept.y.resize(samples);
  if (kept.stamp_offset.size() > 0) kept.stamp_offset.resize(samples);
  if (!kept.valid.empty()) kept.valid.resize(static_cast<std::size_t>(samples));
  for (Eigen::Index k = 0; k < samples; ++k) {
    kept.y[k] = experiment.y[k * thinning];
    if (kept.stamp_offset.size() > 0) kept.stamp_offset[k] = experiment.stamp_offset[k * thinning];
    if (!kept.valid.empty())
      kept.valid[static_cast<std::size_t>(k)] =
          experiment.valid[static_cast<std::size_t>(k * thinning)];
  }
  return kept;
}

std::vector<Experiment> thinned(std::vector<Experiment> experiments, int thinning) {
  for (Experiment& experiment : experiments) experiment = thinned(experiment, thinning);
  return experiments;
}

}  // namespace uncertainty_identification
