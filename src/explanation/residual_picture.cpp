#include "explanation/residual_picture.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "math/constants.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kLags = 20;
constexpr int kBands = 60;  // of the spectrum
constexpr double kBeyond95 = 1.96;

/// Signals of one experiment. The residual is in standard deviations, and 0 where the output was
/// not measured, i.e. where `weight` is 0.
struct Traces {
  VectorXd residual, weight, input, output;
};

/// The signals of all experiments, in their order; `output` is the simulated one.
std::vector<Traces> tracesOf(const Fit& fit, const FitData& data) {
  const Residuals residuals = residualsOf(fit, data);
  std::vector<Traces> all(static_cast<std::size_t>(data.count()));
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    const Block& block = data.blocks()[b];
    const Signals output = fit.model->simulated(block, fit.at.parameters, fit.xi).expected();
    for (int lane = 0; lane < block.lanes; ++lane) {
      const Index length = block.lengths[static_cast<std::size_t>(lane)];
      const auto row = [&](const Signals& signal) {
        return VectorXd(signal.row(lane).head(length).transpose().matrix());
      };
      all[static_cast<std::size_t>(block.index[static_cast<std::size_t>(lane)])] = {
          row(residuals.standardised[b]), row(block.weight), row(block.u), row(output)};
    }
  }
  return all;
}

/// Sums of the residual over bins of equal width of another quantity.
class Bins {
 public:
  Bins(double least, double largest, int count)
      : least_(least), width_((largest - least) / count), sums_(VectorXd::Zero(count)) {
    squares_ = counts_ = sums_;
  }

  void add(double at, double residual) {
    const double place = width_ > 0 ? (at - least_) / width_ : 0;
    const Index bin = std::clamp<Index>(static_cast<Index>(place), 0, sums_.size() - 1);
    sums_[bin] += residual;
    squares_[bin] += residual * residual;
    ++counts_[bin];
  }

  VectorXd centres() const {
    VectorXd values(sums_.size());
    for (Index k = 0; k < values.size(); ++k)
      values[k] = least_ + width_ * (static_cast<double>(k) + 0.5);
    return filled(values);
  }

  VectorXd means() const { return filled(sums_.cwiseQuotient(counts_.cwiseMax(1))); }
  VectorXd powers() const { return filled(squares_.cwiseQuotient(counts_.cwiseMax(1))); }

 private:
  /// The values of the bins that contain enough samples for a mean.
  VectorXd filled(const VectorXd& values) const {
    constexpr double kFewest = 5;
    std::vector<double> kept;
    for (Index k = 0; k < values.size(); ++k)
      if (counts_[k] >= kFewest) kept.push_back(values[k]);
    return Eigen::Map<const VectorXd>(kept.data(), static_cast<Index>(kept.size()));
  }

  double least_, width_;
  VectorXd sums_, squares_, counts_;
};

/// The residual over bins of another signal of the experiments.
Bins binned(const std::vector<Traces>& traces, VectorXd Traces::*of) {
  constexpr int kBins = 25;
  double least = INFINITY, largest = -INFINITY;
  for (const Traces& trace : traces) {
    least = std::min(least, (trace.*of).minCoeff());
    largest = std::max(largest, (trace.*of).maxCoeff());
  }
  Bins bins(least, largest, kBins);
  for (const Traces& trace : traces)
    for (Index t = 0; t < trace.residual.size(); ++t)
      if (trace.weight[t] > 0) bins.add((trace.*of)[t], trace.residual[t]);
  return bins;
}

/// The residual over bins of the time since the beginning of the experiment.
Bins overTime(const std::vector<Traces>& traces, double sample_time) {
  constexpr int kBins = 20;
  Index longest = 0;
  for (const Traces& trace : traces) longest = std::max(longest, trace.residual.size());
  Bins bins(0, sample_time * static_cast<double>(longest), kBins);
  for (const Traces& trace : traces)
    for (Index t = 0; t < trace.residual.size(); ++t)
      if (trace.weight[t] > 0) bins.add(sample_time * static_cast<double>(t), trace.residual[t]);
  return bins;
}

void fillCorrelations(const std::vector<Traces>& traces, ResidualPicture* picture) {
  VectorXd own = VectorXd::Zero(kLags + 1), cross = own;
  double samples = 0, input = 0;
  for (const Traces& trace : traces) {
    const VectorXd u = trace.input.array() - trace.input.mean();
    const Index length = u.size();
    for (Index k = 0; k <= std::min<Index>(kLags, length - 1); ++k) {
      own[k] += trace.residual.tail(length - k).dot(trace.residual.head(length - k));
      cross[k] += trace.residual.tail(length - k).dot(u.head(length - k));
    }
    samples += trace.weight.sum();
    input += u.squaredNorm();
  }
  if (!(own[0] > 0) || !(input > 0)) return;
  for (Index k = 1; k <= kLags; ++k) picture->autocorrelation.push_back(own[k] / own[0]);
  for (Index k = 0; k <= kLags; ++k)
    picture->cross_correlation.push_back(cross[k] / std::sqrt(own[0] * input));
  picture->confidence_95 = kBeyond95 / std::sqrt(samples);
}

/// Periodograms, averaged over the experiments and over bands of equal width in log frequency.
void fillSpectrum(const std::vector<Traces>& traces, double sample_time, ResidualPicture* picture) {
  constexpr double kDecades = 3;  // below the Nyquist frequency
  VectorXd powers = VectorXd::Zero(kBands), counts = powers, logarithms = powers;
  Eigen::FFT<double> transform;
  for (const Traces& trace : traces) {
    std::vector<std::complex<double>> values;
    const std::vector<double> residual(trace.residual.data(),
                                       trace.residual.data() + trace.residual.size());
    transform.fwd(values, residual);
    for (std::size_t k = 1; 2 * k <= residual.size(); ++k) {
      const double share = 2 * static_cast<double>(k) / static_cast<double>(residual.size());
      const auto band = static_cast<Index>(kBands * (1 + std::log10(share) / kDecades));
      const Index at = std::clamp<Index>(band, 0, kBands - 1);
      powers[at] += std::norm(values[k]) / std::max(1.0, trace.weight.sum());
      logarithms[at] += std::log(share * kPi / sample_time);
      ++counts[at];
    }
  }
  std::vector<double> frequency, spectrum;
  for (Index k = 0; k < kBands; ++k) {
    if (counts[k] == 0) continue;
    frequency.push_back(std::exp(logarithms[k] / counts[k]));
    spectrum.push_back(powers[k] / counts[k]);
  }
  const auto size = static_cast<Index>(frequency.size());
  picture->frequency = Eigen::Map<const VectorXd>(frequency.data(), size);
  picture->spectrum = Eigen::Map<const VectorXd>(spectrum.data(), size);
}

}  // namespace

ResidualPicture residualPicture(const Fit& fit, const FitData& data) {
  ResidualPicture picture;
  const std::vector<Traces> traces = tracesOf(fit, data);
  const double sample_time = data.experiments().front().sample_time;
  fillCorrelations(traces, &picture);
  fillSpectrum(traces, sample_time, &picture);
  const Bins input = binned(traces, &Traces::input), output = binned(traces, &Traces::output);
  picture.input_level = input.centres();
  picture.residual_of_input = input.means();
  picture.output_level = output.centres();
  picture.residual_of_output = output.means();
  const Bins time = overTime(traces, sample_time);
  picture.time = time.centres();
  picture.residual_of_time = time.means();
  picture.variance_of_time = time.powers();
  for (const Traces& trace : traces) {
    picture.of_experiment.push_back(
        std::sqrt(trace.residual.squaredNorm() / std::max(1.0, trace.weight.sum())));
  }
  return picture;
}

}  // namespace uncertainty_identification
