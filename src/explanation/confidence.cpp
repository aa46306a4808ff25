#include "explanation/confidence.h"

#include <algorithm>
#include <cmath>

#include "explanation/acceptance.h"
#include "explanation/residual_distribution.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

constexpr Eigen::Index kFewest = 4;  ///< experiments that show how far the experiments agree
constexpr double kMostOfFew = 0.8;   ///< probability where there are fewer
constexpr double kBeyondDoubt = 50;  ///< [nats] by which a rival may be behind and still count

/// ln(Phi(z)/Phi(-z)), the odds that a normal estimate of z standard errors has the right sign.
double logOddsOf(double z) {
  const double wrong = 0.5 * std::erfc(z / std::sqrt(2.0));
  return wrong > 0 ? std::log1p(-wrong) - std::log(wrong) : kBeyondDoubt;
}

/// Logarithm of the odds of the chosen effect against one rival.
double logOdds(const Evidence& chosen, const Evidence& rival) {
  const double lead = chosen.score - rival.score;
  const Eigen::Index count = chosen.gains.size();
  if (lead <= 0 || count < kFewest || rival.gains.size() != count) return lead;
  const Eigen::ArrayXd differences = chosen.gains - rival.gains;
  const double variance =
      (differences - differences.mean()).square().sum() / static_cast<double>(count - 1);
  const double error = std::sqrt(variance * static_cast<double>(count));
  return error > 0 ? std::min(lead, logOddsOf(lead / error)) : lead;
}

Evidence evidenceFor(const SearchState& state, const Fit& fit, double penalty) {
  const PairedGains gains = state.gains(state.fit, fit);
  Evidence evidence;
  evidence.gains.resize(gains.training.size() + gains.held.size());
  evidence.gains << gains.training, gains.held;
  evidence.score = evidence.gains.sum() - penalty;
  return evidence;
}

}  // namespace

double confidenceOf(const Evidence& chosen, const std::vector<Evidence>& rivals) {
  double sum = 1;
  for (const Evidence& rival : rivals)
    sum += std::exp(std::min(-logOdds(chosen, rival), kBeyondDoubt));
  const Eigen::Index count = chosen.gains.size();
  return std::min(1 / sum, count > 0 && count < kFewest ? kMostOfFew : 1.0);
}

double confidenceFor(const SearchState& state, const FittedEffect& chosen, const Fit& fit,
                     const std::vector<FittedEffect>& ranked) {
  const Evidence own = evidenceFor(state, fit, chosen.penalty);
  std::vector<Evidence> rivals;
  for (const FittedEffect& other : ranked) {
    if (other.effect == chosen.effect || other.score < chosen.score - kBeyondDoubt) continue;
    if (other.fit.model && isDifferencing(other.fit)) continue;  // is never accepted
    if (isFormOfOneCause(*other.effect, *chosen.effect)) continue;
    // A distribution of the residuals has no fit of its own.
    rivals.push_back(isResidualDistribution(*other.effect)
                         ? Evidence{other.score, {}}
                         : evidenceFor(state, other.fit, other.penalty));
  }
  return confidenceOf(own, rivals);
}

}  // namespace uncertainty_identification
