#include "explanation/input_steps.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
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
  for (const Experiment& experiment : experiments)
    samples += static_cast<std::size_t>(experiment.u.size());
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
/// curves that steps must not be taken for, and to others.
class ResponseSearch {
 public:
  ResponseSearch(const Residuals& residuals, const Fit& base, const FitData& data,
                 const CommandRange& range)
      : residuals_(residuals.standardised), responses_(base, data), range_(range) {
    constexpr int kPowers = 4;
    for (int power = 0; power < kPowers; ++power)
      smooth_.push_back(responses_.to([&](const Signals& u) -> Signals {
        return ((u - range_.mean) / range_.half).pow(power);
      }));
    gram_.resize(kPowers, kPowers);
    cross_.resize(kPowers);
    for (std::size_t i = 0; i < kPowers; ++i) {
      const auto row = static_cast<Index>(i);
      for (std::size_t j = 0; j < kPowers; ++j)
        gram_(row, static_cast<Index>(j)) = product(smooth_[i], smooth_[j]);
      cross_[row] = product(smooth_[i], residuals_);
    }
  }

  struct Found {
    double gain = 0;        ///< [nats]
    VectorXd coefficients;  ///< one of each function
  };

  Found with(const std::vector<Function>& functions) const {
    const Index smooth = cross_.size(), all = smooth + static_cast<Index>(functions.size());
    std::vector<std::vector<Signals>> answers = smooth_;
    MatrixXd gram(all, all);
    VectorXd cross(all);
    gram.topLeftCorner(smooth, smooth) = gram_;
    cross.head(smooth) = cross_;
    for (const Function& function : functions) {
      const auto row = static_cast<Index>(answers.size());
      answers.push_back(responses_.to(function));
      for (Index i = 0; i <= row; ++i)
        gram(i, row) = gram(row, i) = product(answers[static_cast<std::size_t>(i)], answers.back());
      cross[row] = product(answers.back(), residuals_);
    }
    gram.diagonal() *= 1 + 1e-9;
    const VectorXd solution = gram.ldlt().solve(cross);
    const double without =
        cross_.dot(MatrixXd(gram.topLeftCorner(smooth, smooth)).ldlt().solve(cross_));
    return {0.5 * (cross.dot(solution) - without), solution.tail(all - smooth)};
  }

 private:
  const std::vector<Signals>& residuals_;
  Responses responses_;
  CommandRange range_;
  std::vector<std::vector<Signals>> smooth_;
  MatrixXd gram_;
  VectorXd cross_;
};

/// A sine and a cosine of so many turns per unit of the command.
std::vector<Function> waves(double turns, const CommandRange& range) {
  const auto angle = [=](const Signals& u) -> Signals {
    return 2 * kPi * turns * (u - range.mean);
  };
  return {[=](const Signals& u) -> Signals { return angle(u).sin(); },
          [=](const Signals& u) -> Signals { return angle(u).cos(); }};
}

struct Steps {
  double step = 0, level = 0;
};

/// What rounding adds to the command.
Function rounding(const Steps& steps) {
  return [=](const Signals& u) -> Signals {
    const Signals turns = (u - steps.level) / steps.step;
    return steps.step * (turns.round() - turns);
  };
}

/// The steps about those that the sine shows with which the residuals gain most. A sample that is
/// rounded the wrong way costs much where the command rests there, and the likelihood, which jumps
/// at each, has an optimum beside every one of them.
Steps refined(Steps steps, const ResponseSearch& search, const CommandRange& range) {
  constexpr int kReach = 3, kRounds = 4;
  double turn = 0.1;  // between neighbours: of the level, and of the phase at the range's ends
  for (int round = 0; round < kRounds; ++round, turn /= kReach) {
    const Steps centre = steps;
    const double apart = centre.step * std::min(0.1, turn * centre.step / range.half);
    double best = -1;
    for (int i = -kReach; i <= kReach; ++i)
      for (int j = -kReach; j <= kReach; ++j) {
        const Steps each{centre.step + i * apart, centre.level + j * turn * centre.step};
        const double gain = search.with({rounding(each)}).gain;
        if (!(gain > best)) continue;
        best = gain;
        steps = each;
      }
  }
  return steps;
}

}  // namespace

bool findInputSteps(const Residuals& residuals, const Fit& base, const FitData& data,
                    DataSummary* summary) {
  constexpr double kFewest = 3, kMost = 60;  // steps over the range of the command
  constexpr double kOfATurn = 0.2;           // by which neighbours differ at the ends of the range
  constexpr double kLeast = 10, kAbout = 2;  // [nats]; ratio of amplitudes
  const CommandRange range = rangeOf(data.experiments());
  if (!range.is_fine) return false;
  const ResponseSearch search(residuals, base, data, range);
  const double between = kOfATurn / range.half;
  const double most = std::min(0.5 * kMost / range.half, 0.4 / std::max(range.grid, 1e-300));
  double turns = 0;
  ResponseSearch::Found best;
  const auto ask = [&](double candidate) {
    ResponseSearch::Found found = search.with(waves(candidate, range));
    if (!(found.gain > best.gain)) return;
    best = std::move(found);
    turns = candidate;
  };
  for (double at = 0.5 * kFewest / range.half; at < most; at += between) ask(at);
  for (double step = between / 2; step > 1e-3 * between; step /= 2)
    for (const double candidate : {turns - step, turns + step}) ask(candidate);
  if (best.gain < kLeast) return false;
  // round((u - s)/q) q + s - u is nearly -q/pi sin(2 pi (u - s)/q).
  const double sine = best.coefficients[0], cosine = best.coefficients[1];
  const double amplitude = std::hypot(sine, cosine) * kPi * turns;
  if (amplitude > kAbout || amplitude < 1 / kAbout) return false;
  const Steps steps = refined(
      {1 / turns, range.mean + std::atan2(cosine, -sine) / (2 * kPi * turns)}, search, range);
  // A ripple of the command, as of a worn gear, is a sine itself.
  const ResponseSearch::Found rounded = search.with({rounding(steps)});
  if (rounded.gain < best.gain || rounded.coefficients[0] > kAbout ||
      rounded.coefficients[0] < 1 / kAbout)
    return true;
  summary->input_step = steps.step;
  summary->input_level = steps.level;
  return true;
}

}  // namespace uncertainty_identification
