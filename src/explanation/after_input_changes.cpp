#include "explanation/after_input_changes.h"

#include <algorithm>
#include <cmath>

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

}  // namespace uncertainty_identification
