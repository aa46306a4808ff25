#include "explanation/input_steps.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "math/constants.h"
#include "math/polynomial.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

using Function = std::function<Signals(const Signals& u)>;

/// Where 98 % of the command lie, and the least difference of two of its values; 0 where it takes
/// too many to tell. `is_fine`: it takes enough values to show steps.
struct CommandRange {
  double mean = 0, half = 0, grid = 0;
  bool is_fine = false;
};

CommandRange rangeOf(const std::vector<Experiment>& experiments) {
  constexpr std::size_t kFewest = 30, kMany = 4000, kMost = 200000;  // values; samples
  std::vector<double> values;
  std::size_t samples = 0;
  for (const Experiment& experiment : experiments) samples += experiment.u.size();
  const auto every = static_cast<Index>(samples / kMost + 1);
  for (const Experiment& experiment : experiments)
    for (Index t = 0; t < experiment.u.size(); t += every) values.push_back(experiment.u[t]);
  std::sort(values.begin(), values.end());
  const auto end = static_cast<double>(values.size()) - 1;
  const double low = values[static_cast<std::size_t>(0.01 * end)],
               high = values[static_cast<std::size_t>(0.99 * end)];
  values.erase(std::unique(values.begin(), values.end()), values.end());
  CommandRange range{0.5 * (low + high), 0.5 * (high - low), 0, false};
  range.is_fine = values.size() >= kFewest && range.half > 0;
  if (!range.is_fine || values.size() > kMany) return range;
  range.grid = high - low;
  for (std::size_t k = 1; k < values.size(); ++k)
    range.grid = std::min(range.grid, values[k] - values[k - 1]);
  return range;
}

/// What the model answers to functions of the command, whitened as its residuals are, in standard
/// deviations of the noise.
class Responses {
 public:
  Responses(const Fit& base, const FitData& data)
      : data_(data),
        polynomials_(base.model->nominal().polynomials(
            base.at.parameters.head(base.model->nominal().parameterCount()))),
        deviation_(std::sqrt(base.at.noise_variance)) {
    constexpr int kEnough = 60000;  // samples that show steps
    int samples = 0;
    for (const Block& block : data.blocks()) {
      if (samples >= kEnough) break;
      columns_.push_back(std::min(block.samples, (kEnough - samples) / block.lanes + 1));
      samples += columns_.back() * block.lanes;
    }
  }

  /// One signal per block, of the first samples that are enough.
  std::vector<Signals> to(const Function& function) const {
    std::vector<Signals> all;
    for (std::size_t b = 0; b < columns_.size(); ++b) {
      const Block& block = data_.blocks()[b];
      Signals answer, whitened;
      filter(polynomials_.b, polynomials_.a, polynomials_.delay,
             function(block.u.leftCols(columns_[b])), &answer);
      filter(withLeadingOne(polynomials_.d), polynomials_.c, 0, answer, &whitened);
      all.push_back(whitened * block.weight.leftCols(columns_[b]) / deviation_);
    }
    return all;
  }

 private:
  const FitData& data_;
  Polynomials polynomials_;
  double deviation_;
  std::vector<int> columns_;  ///< samples of each block that are used
};

/// Over the samples of `left`, which may be the first ones of `right`.
double product(const std::vector<Signals>& left, const std::vector<Signals>& right) {
  double sum = 0;
  for (std::size_t b = 0; b < left.size(); ++b)
    sum += (left[b] * right[b].leftCols(left[b].cols())).sum();
  return sum;
}

/// Least squares of the residuals on the answers to smooth functions of the command, a line and
/// curves that steps must not be taken for, and to a sine of it.
class SineSearch {
 public:
  SineSearch(const Residuals& residuals, const Fit& base, const FitData& data,
             const CommandRange& range)
      : residuals_(residuals.standardised), responses_(base, data), range_(range) {
    constexpr int kPowers = 4;
    for (int power = 0; power < kPowers; ++power)
      smooth_.push_back(responses_.to([&](const Signals& u) -> Signals {
        return ((u - range_.mean) / range_.half).pow(power);
      }));
    gram_.resize(kPowers, kPowers);
    cross_.resize(kPowers);
    for (int i = 0; i < kPowers; ++i) {
      for (int j = 0; j < kPowers; ++j) gram_(i, j) = product(smooth_[i], smooth_[j]);
      cross_[i] = product(smooth_[i], residuals_);
    }
  }

  struct Found {
    double gain = 0;  ///< [nats]
    double sine = 0, cosine = 0;
  };

  /// The sine and cosine of so many turns per unit of the command.
  Found at(double turns) const {
    const Index smooth = cross_.size();
    std::vector<std::vector<Signals>> waves;
    waves.push_back(responses_.to(
        [&](const Signals& u) -> Signals { return (2 * kPi * turns * (u - range_.mean)).sin(); }));
    waves.push_back(responses_.to(
        [&](const Signals& u) -> Signals { return (2 * kPi * turns * (u - range_.mean)).cos(); }));
    MatrixXd gram(smooth + 2, smooth + 2);
    VectorXd cross(smooth + 2);
    gram.topLeftCorner(smooth, smooth) = gram_;
    cross.head(smooth) = cross_;
    for (Index k = 0; k < 2; ++k) {
      const auto& wave = waves[static_cast<std::size_t>(k)];
      for (Index i = 0; i < smooth; ++i)
        gram(i, smooth + k) = gram(smooth + k, i) =
            product(smooth_[static_cast<std::size_t>(i)], wave);
      for (Index i = 0; i < 2; ++i)
        gram(smooth + i, smooth + k) = product(waves[static_cast<std::size_t>(i)], wave);
      cross[smooth + k] = product(wave, residuals_);
    }
    gram.diagonal() *= 1 + 1e-9;
    const VectorXd all = gram.ldlt().solve(cross);
    const double without =
        cross_.dot(MatrixXd(gram.topLeftCorner(smooth, smooth)).ldlt().solve(cross_));
    return {0.5 * (cross.dot(all) - without), all[smooth], all[smooth + 1]};
  }

 private:
  const std::vector<Signals>& residuals_;
  Responses responses_;
  CommandRange range_;
  std::vector<std::vector<Signals>> smooth_;
  MatrixXd gram_;
  VectorXd cross_;
};

}  // namespace

void findInputSteps(const Residuals& residuals, const Fit& base, const FitData& data,
                    DataSummary* summary) {
  constexpr double kFewest = 3, kMost = 60;  // steps over the range of the command
  constexpr double kOfATurn = 0.2;           // by which neighbours differ at the ends of the range
  constexpr double kLeast = 10, kAbout = 2;  // [nats]; ratio of amplitudes
  const CommandRange range = rangeOf(data.experiments());
  if (!range.is_fine) return;
  const SineSearch search(residuals, base, data, range);
  const double between = kOfATurn / range.half;
  const double most = std::min(0.5 * kMost / range.half, 0.4 / std::max(range.grid, 1e-300));
  double turns = 0;
  SineSearch::Found best;
  const auto ask = [&](double candidate) {
    const SineSearch::Found found = search.at(candidate);
    if (!(found.gain > best.gain)) return;
    best = found;
    turns = candidate;
  };
  for (double at = 0.5 * kFewest / range.half; at < most; at += between) ask(at);
  for (double step = between / 2; step > 1e-3 * between; step /= 2)
    for (const double candidate : {turns - step, turns + step}) ask(candidate);
  // round((u - s)/q) q + s - u is nearly -q/pi sin(2 pi (u - s)/q).
  const double amplitude = std::hypot(best.sine, best.cosine) * kPi * turns;
  if (best.gain < kLeast || amplitude > kAbout || amplitude < 1 / kAbout) return;
  summary->input_step = 1 / turns;
  summary->input_level = range.mean + std::atan2(best.cosine, -best.sine) / (2 * kPi * turns);
}

}  // namespace uncertainty_identification
