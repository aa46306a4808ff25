#include "explanation/after_input_changes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "math/distributions.h"

namespace uncertainty_identification {
namespace {

/// The standard deviation of the input over all experiments.
double deviationOfInput(const FitData& data) {
  double sum = 0, squares = 0, count = 0;
  for (const Experiment& experiment : data.experiments()) {
    sum += experiment.u.sum();
    squares += experiment.u.squaredNorm();
    count += experiment.samples();
  }
  return std::sqrt(std::max(squares / count - std::pow(sum / count, 2), 0.0));
}

/// 1 at the samples at most kReach behind the time at which a large change of the input acts.
Eigen::ArrayXd behindChanges(const Eigen::VectorXd& u, double large, int delay, Eigen::Index size) {
  constexpr int kReach = 6;
  Eigen::ArrayXd behind = Eigen::ArrayXd::Zero(size);
  for (Eigen::Index t = 1; t < u.size(); ++t) {
    if (std::abs(u[t] - u[t - 1]) < large) continue;
    const Eigen::Index first = std::min<Eigen::Index>(t + delay, size);
    behind.segment(first, std::min<Eigen::Index>(kReach, size - first)).setOnes();
  }
  return behind;
}

/// Changes of a signal, in units of their root mean square over the record; 0 where it stands
/// still.
Eigen::ArrayXd relativeChanges(const Eigen::VectorXd& x) {
  Eigen::ArrayXd changes = Eigen::ArrayXd::Zero(x.size());
  if (x.size() < 2) return changes;
  changes.tail(x.size() - 1) = (x.tail(x.size() - 1) - x.head(x.size() - 1)).array().abs();
  const double typical = std::sqrt(changes.square().mean());
  return typical > 0 ? Eigen::ArrayXd(changes / typical) : changes;
}

/// The largest of the changes within the last `reach` samples.
Eigen::ArrayXd largestOfLast(const Eigen::ArrayXd& changes, Eigen::Index reach) {
  Eigen::ArrayXd largest = changes;
  for (Eigen::Index k = 1; k <= std::min(reach, changes.size() - 1); ++k)
    largest.tail(changes.size() - k) =
        largest.tail(changes.size() - k).max(changes.head(changes.size() - k));
  return largest;
}

/// How much the input and the covariates have changed just before, or within the delay.
Eigen::ArrayXd recentChanges(const Experiment& experiment, int delay) {
  constexpr Eigen::Index kReach = 3;
  Eigen::ArrayXd sum = largestOfLast(relativeChanges(experiment.u), kReach + delay);
  for (const auto& [name, values] : experiment.signals)
    sum += largestOfLast(relativeChanges(values), kReach + delay);
  return sum;
}

/// Ranks, of which equal values share their mean.
Eigen::ArrayXd ranksOf(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  Eigen::ArrayXd ranks(static_cast<Eigen::Index>(values.size()));
  for (std::size_t first = 0, last = 0; first < order.size(); first = last) {
    while (last < order.size() && values[order[last]] == values[order[first]]) ++last;
    for (std::size_t k = first; k < last; ++k)
      ranks[static_cast<Eigen::Index>(order[k])] = 0.5 * static_cast<double>(first + last - 1);
  }
  return ranks;
}

}  // namespace

double afterInputChanges(const std::vector<Signals>& marked, const FitData& data, int delay) {
  constexpr double kLarge = 0.5;  // standard deviations of the input
  const double large = kLarge * deviationOfInput(data);
  double samples = 0, behind = 0, found = 0, found_behind = 0;
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    const Block& block = data.blocks()[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      const Experiment& experiment = *block.experiments[static_cast<std::size_t>(lane)];
      const Eigen::ArrayXd weight = block.weight.row(lane).transpose(),
                           mark = marked[b].row(lane).transpose() * weight,
                           near = behindChanges(experiment.u, large, delay, weight.size());
      samples += weight.sum();
      behind += (weight * near).sum();
      found += mark.sum();
      found_behind += (mark * near).sum();
    }
  }
  if (large <= 0 || found_behind == 0 || behind == samples) return 1;
  return binomialTail(found_behind - 1, found, behind / samples);
}

double sizeByChanges(const std::vector<Signals>& residuals, const FitData& data, int delay) {
  constexpr double kNegligible = 0.15;  // of a correlation
  std::vector<double> sizes, changes;
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    const Block& block = data.blocks()[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      const Experiment& experiment = *block.experiments[static_cast<std::size_t>(lane)];
      const Eigen::ArrayXd recent = recentChanges(experiment, delay);
      for (Eigen::Index t = 0; t < recent.size(); ++t) {
        if (block.weight(lane, t) == 0) continue;
        sizes.push_back(std::abs(residuals[b](lane, t)));
        changes.push_back(recent[t]);
      }
    }
  }
  if (sizes.size() < 3) return 1;
  Eigen::ArrayXd x = ranksOf(sizes), y = ranksOf(changes);
  x -= x.mean();
  y -= y.mean();
  const double scale = std::sqrt(x.square().sum() * y.square().sum());
  const double correlation = scale > 0 ? (x * y).sum() / scale : 0;
  if (correlation < kNegligible) return 1;
  return normalTail(correlation * std::sqrt(static_cast<double>(sizes.size() - 1)));
}

}  // namespace uncertainty_identification
