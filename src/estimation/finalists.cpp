#include "estimation/finalists.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/scoring.h"

namespace uncertainty_identification {
namespace {

/// A finalist with what its last turn gained.
struct Climber {
  Finalist at;
  double gain = std::numeric_limits<double>::infinity();
  bool ended = false;  ///< at its optimum, as far as scoring steps go
};

/// Whether two points are on the way to the same optimum: about equally likely and close together.
bool haveMet(const Model& model, const Finalist& one, const Finalist& other) {
  constexpr double kAlike = 3, kClose = 0.05;  // [nats], relative
  if (std::abs(one.log_likelihood - other.log_likelihood) > kAlike) return false;
  if (one.point.mixture.components() != other.point.mixture.components()) return false;
  const Eigen::VectorXd here = model.toUnbounded(one.point.parameters),
                        there = model.toUnbounded(other.point.parameters);
  return (here - there).norm() <= kClose * here.norm();
}

/// Whether a climber so far below the highest would not reach it at the pace of its last turn.
bool isHopeless(const Climber& climber, double highest) {
  constexpr double kFar = 20, kTurns = 4;  // [nats]
  const double behind = highest - climber.at.log_likelihood;
  return behind > kFar && behind > kTurns * climber.gain;
}

void takeTurn(const Likelihood& likelihood, OptimisationOptions options, Climber* climber) {
  constexpr int kSteps = 3;
  constexpr double kTolerance = 1e-3;
  options.floor = covarianceFloor(climber->at.point.mixture);
  const double before = climber->at.log_likelihood;
  climber->at.point = scoringSteps(likelihood, climber->at.point, options, kSteps, kTolerance,
                                   &climber->at.log_likelihood);
  climber->gain = climber->at.log_likelihood - before;
  climber->ended = !(climber->gain >= kTolerance);
}

/// Sorts the climbers and removes those that need not go on.
void sift(const Model& model, std::vector<Climber>* climbers) {
  std::vector<Climber> left;
  std::stable_sort(climbers->begin(), climbers->end(),
                   [](const Climber& one, const Climber& other) {
                     return one.at.log_likelihood > other.at.log_likelihood;
                   });
  for (Climber& climber : *climbers) {
    if (!std::isfinite(climber.at.log_likelihood)) continue;
    if (!left.empty() && isHopeless(climber, left.front().at.log_likelihood)) continue;
    const bool met = std::any_of(left.begin(), left.end(), [&](const Climber& higher) {
      return haveMet(model, higher.at, climber.at);
    });
    if (!met) left.push_back(std::move(climber));
  }
  *climbers = std::move(left);
}

}  // namespace

std::vector<Finalist> climbTogether(const Likelihood& likelihood,
                                    const std::vector<Finalist>& points,
                                    const OptimisationOptions& options, int rounds) {
  std::vector<Climber> climbers;
  climbers.reserve(points.size());
  for (const Finalist& point : points) climbers.push_back({point});
  sift(likelihood.model(), &climbers);
  for (int round = 0; round < rounds; ++round) {
    bool moved = false;
    for (Climber& climber : climbers) {
      if (climber.ended) continue;
      takeTurn(likelihood, options, &climber);
      moved = true;
    }
    if (!moved) break;
    sift(likelihood.model(), &climbers);
  }
  std::vector<Finalist> left;
  left.reserve(climbers.size());
  for (Climber& climber : climbers) left.push_back(std::move(climber.at));
  return left;
}

}  // namespace uncertainty_identification
