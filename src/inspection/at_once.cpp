#include "inspection/at_once.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "inspection/common_records.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kPastReadings = 6;  // [samples] of each signal
constexpr int kOfPasts = 2 * kPastReadings + 1;
constexpr double kFewestReadings = 60;   // samples
constexpr double kOftenMoves = 1.0 / 3;  // share of the readings at which the input is another

/// 1 and the past of both signals, less their first values, which keeps digits; then u(t), y(t).
VectorXd rowAt(const CommonRecord& record, Index t) {
  VectorXd row(kOfPasts + 2);
  row << 1, record.u.segment(t - kPastReadings, kPastReadings).array() - record.u[0],
      record.y.segment(t - kPastReadings, kPastReadings).array() - record.y[0],
      record.u[t] - record.u[0], record.y[t] - record.y[0];
  return row;
}

double shareOfMoves(const std::vector<CommonRecord>& records) {
  double moves = 0, readings = 0;
  for (const CommonRecord& record : records) {
    const Index steps = record.u.size() - 1;
    moves +=
        static_cast<double>((record.u.tail(steps).array() != record.u.head(steps).array()).count());
    readings += static_cast<double>(steps);
  }
  return readings > 0 ? moves / readings : 0;
}

/// Covariance of what the pasts leave of u(t) and y(t), times the number of samples.
Matrix2d leftOf(const MatrixXd& gram) {
  const VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt();
  MatrixXd scaled = scale.cwiseInverse().asDiagonal() * gram * scale.cwiseInverse().asDiagonal();
  MatrixXd past = scaled.topLeftCorner(kOfPasts, kOfPasts);
  past.diagonal().array() += 1e-12;
  const MatrixXd cross = scaled.topRightCorner(kOfPasts, 2);
  return scaled.bottomRightCorner(2, 2) - cross.transpose() * past.ldlt().solve(cross);
}

}  // namespace

bool AtOnce::matters() const {
  constexpr double kMost = 0.45, kBeyondChance = 4;  // standard deviations of it
  return samples > 0 &&
         std::abs(correlation) > std::max(kMost, kBeyondChance / std::sqrt(samples - kOfPasts - 3));
}

AtOnce atOnceOf(const Channel& input, const Channel& output) {
  constexpr double kNothingNew = 1e-10;  // of the mean square about the first value: rounding
  // What an input does between slower readings of the output is answered in the next one.
  constexpr double kAsFast = 0.7;
  AtOnce found;
  const double period = ownPeriod(output);
  if (!(period > 0) || ownPeriod(input) < kAsFast * period) return found;
  const std::vector<CommonRecord> records = commonRecords(input, output, period, kPastReadings);
  MatrixXd gram = MatrixXd::Zero(kOfPasts + 2, kOfPasts + 2);
  double samples = 0;
  for (const CommonRecord& record : records) {
    for (Index t = kPastReadings; t < record.u.size(); ++t, ++samples) {
      const VectorXd row = rowAt(record, t);
      gram += row * row.transpose();
    }
  }
  if (samples < kFewestReadings || shareOfMoves(records) < kOftenMoves) return found;
  const Matrix2d left = leftOf(gram);
  if (!(left(0, 0) > kNothingNew && left(1, 1) > kNothingNew)) return found;
  found.samples = samples;
  found.correlation = left(0, 1) / std::sqrt(left(0, 0) * left(1, 1));
  const double distance = std::atanh(std::min(std::abs(found.correlation), 1 - 1e-12)) *
                          std::sqrt(samples - kOfPasts - 3);
  found.p_value = std::erfc(distance / std::sqrt(2.0));
  return found;
}

}  // namespace uncertainty_identification
