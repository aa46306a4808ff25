#include "curves/record_difference.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "curves/held_out.h"

namespace uncertainty_identification {
namespace {

using In = RecordDifference::In;

/// One signal over all windows, what was not measured being zero.
Eigen::VectorXd joined(const SimulationData& record, const std::vector<Eigen::VectorXd>& signals) {
  Eigen::Index total = 0;
  for (const Eigen::VectorXd& signal : signals) total += signal.size();
  Eigen::VectorXd all(total);
  Eigen::Index at = 0;
  for (std::size_t w = 0; w < signals.size(); ++w) {
    const SimulationWindow& window = record.windows[w];
    all.segment(at, signals[w].size()) = signals[w].array() * window.measured;
    all.segment(at, window.rest).setZero();
    at += signals[w].size();
  }
  return all;
}

Eigen::VectorXd measured(const SimulationData& record) {
  std::vector<Eigen::VectorXd> y;
  y.reserve(record.windows.size());
  for (const SimulationWindow& window : record.windows) y.push_back(window.y);
  return joined(record, y);
}

Eigen::VectorXd simulated(const SimulationData& record, const CurveModel& model) {
  return joined(record, heldOutSimulations(record, model));
}

/// The input that many samples later, or earlier.
SimulationData delayed(SimulationData record, int samples) {
  for (SimulationWindow& window : record.windows) {
    const Eigen::VectorXd u = window.u;
    for (Eigen::Index k = 0; k < u.size(); ++k)
      window.u[k] = u[std::min(std::max<Eigen::Index>(k - samples, 0), u.size() - 1)];
  }
  return record;
}

/// The candidates for the difference of one record, each with its squared error.
class Differences {
 public:
  Differences(const SimulationData& record, const CurveModel& linear)
      : record_(record),
        linear_(linear),
        y_(measured(record)),
        error_(y_ - simulated(record, linear)) {}

  double before() const { return error_.squaredNorm(); }
  double samples() const {  ///< measured
    double count = 0;
    for (const SimulationWindow& window : record_.windows) count += window.measuredSamples();
    return count;
  }

  /// The simulation is linear in the gain and in the bias of the input.
  void addGainAndOffset() {
    CurveModel more = linear_, biased = linear_;
    more.theta.segment(more.order, more.order + (more.direct ? 1 : 0)) *= 2;
    biased.theta[biased.biasIndex()] += 1;
    const Eigen::VectorXd now = y_ - error_;
    Eigen::MatrixXd by(now.size(), 2);
    by << simulated(record_, biased) - now, simulated(record_, more) - now;
    if (!by.allFinite()) return;
    const double bias = by.col(0).dot(error_) / std::max(by.col(0).squaredNorm(), 1e-12);
    Eigen::Index settled = 0;
    by.col(0).cwiseAbs().maxCoeff(&settled);
    add(In::offset, bias * by(settled, 0) * record_.scales.y.unit,
        (error_ - bias * by.col(0)).squaredNorm());
    const Eigen::Vector2d both = by.colPivHouseholderQr().solve(error_);
    add(In::gain, 1 + both[1], (error_ - by * both).squaredNorm());
  }

  void addDelays() {
    const int most = std::min(20, record_.longest / 6);
    for (int samples = -most; samples <= most; ++samples)
      add(In::delay, samples * record_.sample_time,
          (y_ - simulated(delayed(record_, samples), linear_)).squaredNorm());
  }

  /// The difference with the least error; a gain, which comes with an offset, has to be clearly
  /// better than one number alone.
  std::optional<RecordDifference> best() const {
    constexpr double kExplained = 0.25;  // of the squared error is left
    if (!(error_of_best_ < kExplained * before())) return std::nullopt;
    RecordDifference found = best_;
    found.record = record_.windows.front().record;
    found.fit_before = heldOutFit(record_, Eigen::VectorXd::Constant(1, before()));
    found.fit_after = heldOutFit(record_, Eigen::VectorXd::Constant(1, error_of_best_));
    return found;
  }

 private:
  void add(In in, double value, double error) {
    constexpr double kTwoNumbers = 1.25;
    const double penalised = in == In::gain ? kTwoNumbers * error : error;
    if (!(penalised < least_)) return;
    least_ = penalised;
    error_of_best_ = error;
    best_.in = in;
    best_.value = value;
  }

  const SimulationData& record_;
  const CurveModel& linear_;
  Eigen::VectorXd y_, error_;
  RecordDifference best_;
  double least_ = std::numeric_limits<double>::infinity(),
         error_of_best_ = std::numeric_limits<double>::infinity();
};

}  // namespace

std::optional<RecordDifference> differenceOf(const SimulationData& held, const CurveModel& linear) {
  std::optional<RecordDifference> most;
  double worst = 0;
  for (const std::vector<int>& windows : windowsByRecord(held)) {
    const SimulationData record = onlyOf(held, windows);
    Differences differences(record, linear);
    differences.addGainAndOffset();
    differences.addDelays();
    const auto found = differences.best();
    const double error = differences.before() / std::max(differences.samples(), 1.0);
    if (!found || error <= worst) continue;
    worst = error;
    most = found;
  }
  return most;
}

std::string inWords(const RecordDifference& difference, const std::string& experiment) {
  std::ostringstream text;
  text.precision(3);
  text << "experiment '" << experiment << "' was not fitted to. The linear plant simulates it by "
       << difference.fit_before << " %, and by " << difference.fit_after << " % with ";
  if (difference.in == In::offset)
    text << "an output that is higher by " << difference.value << " (unit of y)";
  else if (difference.in == In::delay)
    text << "an input that acts " << std::abs(difference.value) << " s "
         << (difference.value > 0 ? "later" : "earlier");
  else
    text << difference.value << " times the gain, and an offset of its own";
  text << ": that is most of how it differs from the others";
  return text.str();
}

}  // namespace uncertainty_identification
