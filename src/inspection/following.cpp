#include "inspection/following.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "inspection/at_once.h"
#include "inspection/common_records.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kOrder = 10;        // [samples] of its past that predict a signal
constexpr int kLags = 20;         // at which signals may answer
constexpr Index kLate = 40;       // up to which lags show what chance does
constexpr double kFewest = 5;     // times the lags, samples that correlations need
constexpr double kMatters = 0.1;  // correlation below which nothing is concluded
constexpr double kBeyondChance = 1.5;
constexpr double kShareOfAnswer = 0.5;  // of the correlation the other way round

/// 1, x(t - 1), ..., x(t - kOrder).
VectorXd pastOf(const VectorXd& x, Index t) {
  VectorXd past(kOrder + 1);
  past << 1, x.segment(t - kOrder, kOrder).reverse();
  return past;
}

/// What the own past does not predict of a signal, in each record.
std::vector<VectorXd> novelties(const std::vector<CommonRecord>& records,
                                VectorXd CommonRecord::*signal) {
  MatrixXd gram = MatrixXd::Zero(kOrder + 1, kOrder + 1);
  VectorXd right = VectorXd::Zero(kOrder + 1);
  for (const CommonRecord& record : records) {
    const VectorXd& x = record.*signal;
    for (Index t = kOrder; t < x.size(); ++t) {
      const VectorXd past = pastOf(x, t);
      gram.selfadjointView<Eigen::Lower>().rankUpdate(past);
      right += past * x[t];
    }
  }
  gram = gram.selfadjointView<Eigen::Lower>();
  gram.diagonal().array() += 1e-10 * gram.diagonal().maxCoeff() + 1e-300;
  const VectorXd predictor = gram.ldlt().solve(right);
  std::vector<VectorXd> novel;
  for (const CommonRecord& record : records) {
    const VectorXd& x = record.*signal;
    VectorXd left(x.size() - kOrder);
    for (Index t = kOrder; t < x.size(); ++t) left[t - kOrder] = x[t] - predictor.dot(pastOf(x, t));
    novel.push_back(std::move(left));
  }
  return novel;
}

double energyOf(const std::vector<VectorXd>& signals) {
  double energy = 0;
  for (const VectorXd& signal : signals) energy += signal.squaredNorm();
  return energy;
}

/// Sum of later(t) earlier(t - lag).
double laggedProduct(const std::vector<VectorXd>& later, const std::vector<VectorXd>& earlier,
                     Index lag) {
  double sum = 0;
  for (std::size_t r = 0; r < later.size(); ++r) {
    const Index count = later[r].size() - lag;
    if (count > 0) sum += later[r].tail(count).dot(earlier[r].head(count));
  }
  return sum;
}

/// Correlation of later(t) with earlier(t - lag) for lags from 0 to `most`.
std::vector<double> correlations(const std::vector<VectorXd>& later,
                                 const std::vector<VectorXd>& earlier, Index most) {
  const double scale = std::sqrt(energyOf(later) * energyOf(earlier));
  std::vector<double> found;
  for (Index lag = 0; lag <= most; ++lag)
    found.push_back(laggedProduct(later, earlier, lag) / scale);
  return found;
}

/// Takes off a correlation of u with an earlier y what the answer of y to u makes of a correlation
/// of u with its own past. There is one beyond kOrder where u holds its values for longer. Where
/// this explains nothing, as of a chirp, which is never new, the correlation stays.
void takeOffOwnPast(const std::vector<double>& y_after_u, const std::vector<double>& u_after_u,
                    std::vector<double>& u_after_y) {
  for (std::size_t lag = 1; lag < u_after_y.size(); ++lag) {
    double own = 0;
    for (std::size_t delay = 0; delay <= kLags; ++delay)
      if (lag + delay > kOrder && std::abs(u_after_u[lag + delay]) > kMatters)
        own += y_after_u[delay] * u_after_u[lag + delay];
    const double rest = u_after_y[lag] - own;
    if (std::abs(rest) < std::abs(u_after_y[lag])) u_after_y[lag] = rest;
  }
}

/// The largest correlation within kLags, its lag, and the largest at the lags beyond.
struct LargestCorrelation {
  double size = 0;
  Index lag = 0;
  double late = 0;
};

LargestCorrelation largestOf(const std::vector<double>& found, Index first) {
  LargestCorrelation largest;
  for (Index lag = first; lag <= kLate; ++lag) {
    const double size = std::abs(found[static_cast<std::size_t>(lag)]);
    if (lag > kLags) largest.late = std::max(largest.late, size);
    if (lag > kLags || size <= largest.size) continue;
    largest.size = size;
    largest.lag = lag;
  }
  return largest;
}

bool matters(double correlation, double chance) {
  return correlation > std::max(kMatters, kBeyondChance * chance);
}

}  // namespace

bool Following::outputFollows() const {
  return measured && matters(after, chance) && after > kShareOfAnswer * before;
}

bool Following::inputFollows() const {
  return measured && matters(before, chance) && before > kShareOfAnswer * after;
}

bool Following::moveTogether() const {
  constexpr double kMost = 0.6;  // correlation
  return at_once.matters() || (outputFollows() && delay == 0 && after > kMost);
}

Following followingOf(const Channel& input, const Channel& output, double output_band,
                      double period) {
  Following following;
  following.period = period > 0 ? period : periodFor(output, output_band, kLate);
  if (!(following.period > 0)) return following;
  following.at_once = atOnceOf(input, output);
  const std::vector<CommonRecord> records = commonRecords(input, output, following.period, kOrder);
  double samples = 0;
  for (const CommonRecord& record : records) samples += static_cast<double>(record.u.size());
  if (samples < kFewest * kLate) return following;
  const std::vector<VectorXd> u = novelties(records, &CommonRecord::u);
  const std::vector<VectorXd> y = novelties(records, &CommonRecord::y);
  if (!(energyOf(u) * energyOf(y) > 0)) return following;
  const std::vector<double> y_after_u = correlations(y, u, kLate);
  std::vector<double> u_after_y = correlations(u, y, kLate);
  takeOffOwnPast(y_after_u, correlations(u, u, kLate + kLags), u_after_y);
  const LargestCorrelation after = largestOf(y_after_u, 0), before = largestOf(u_after_y, 1);
  following.measured = true;
  following.after = after.size;
  following.delay = static_cast<double>(after.lag) * following.period;
  following.before = before.size;
  following.lead = static_cast<double>(before.lag) * following.period;
  following.chance = std::max({2 / std::sqrt(samples), after.late, before.late});
  return following;
}

}  // namespace uncertainty_identification
