#include "curves/prediction_check.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "curves/fit_comparison.h"
#include "curves/held_out.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kLags = 8, kRowsPerColumn = 5;

/// Regressions of all recorded samples of the windows from `first` on: a constant, past outputs,
/// inputs, and the simulations `before` and `after`; the last column is the output.
struct Regression {
  MatrixXd rows;
  std::vector<Index> begin;  ///< of the rows of each window that has any, and the number of rows
};

Regression regressionOf(const SimulationData& data, const std::vector<VectorXd>& before,
                        const std::vector<VectorXd>& after, Index first) {
  Regression all;
  Index count = 0;
  for (const SimulationWindow& window : data.windows)
    count += std::max<Index>(0, window.samples() - first);
  all.rows.resize(count, 4 * kLags + 5);
  Index row = 0;
  for (std::size_t w = 0; w < data.windows.size(); ++w) {
    const SimulationWindow& window = data.windows[w];
    if (all.begin.empty() || row > all.begin.back()) all.begin.push_back(row);
    for (Index t = std::max<Index>(first, window.rest); t < window.samples(); ++t) {
      if (window.measured.segment(t - kLags, kLags + 1).minCoeff() == 0) continue;
      const auto until = [&](const VectorXd& x, Index last) {
        return x.segment(t - kLags, kLags + 1 + last).transpose();
      };
      all.rows.row(row++) << 1, until(window.y, -1), until(window.u, 0), until(before[w], 0),
          until(after[w], 0), window.y[t];
    }
  }
  if (all.begin.empty() || row > all.begin.back()) all.begin.push_back(row);
  all.rows.conservativeResize(row, Eigen::NoChange);
  return all;
}

/// Least squares of the output on the first `columns`.
VectorXd coefficientsOf(const Regression& fitted, Index columns) {
  const VectorXd scale =
      fitted.rows.leftCols(columns).colwise().norm().cwiseMax(1e-12).cwiseInverse();
  const MatrixXd regressors = fitted.rows.leftCols(columns) * scale.asDiagonal();
  MatrixXd gram = regressors.transpose() * regressors;
  gram.diagonal().array() += 1e-9;
  return scale.asDiagonal() * gram.ldlt().solve(regressors.transpose() * fitted.rows.rightCols(1));
}

/// Squared errors of predicting the output of each held-out window by the first `columns`.
VectorXd errorsOf(const Regression& fitted, const Regression& held, Index columns) {
  const VectorXd theta = coefficientsOf(fitted, columns);
  const VectorXd error = held.rows.rightCols(1) - held.rows.leftCols(columns) * theta;
  VectorXd sums(static_cast<Index>(held.begin.size()) - 1);
  for (Index w = 0; w < sums.size(); ++w) {
    const Index begin = held.begin[static_cast<std::size_t>(w)];
    sums[w] =
        error.segment(begin, held.begin[static_cast<std::size_t>(w) + 1] - begin).squaredNorm();
  }
  return sums;
}

}  // namespace

std::optional<PredictionGain> predictionGain(const SimulationData& data, const SimulationData& held,
                                             const CurveModel& before, const CurveModel& after) {
  const auto seenBy = [&](const SimulationData& windows) -> Index {
    return std::max(seenSamples(windows, before), seenSamples(windows, after));
  };
  const Regression fitted = regressionOf(data, heldOutSimulations(data, before),
                                         heldOutSimulations(data, after), seenBy(data)),
                   unseen = regressionOf(held, heldOutSimulations(held, before),
                                         heldOutSimulations(held, after), seenBy(held));
  const Index columns = fitted.rows.cols() - 1;
  const bool enough = fitted.rows.rows() >= kRowsPerColumn * columns &&
                      unseen.rows.rows() >= columns && unseen.begin.size() > 2;
  if (!enough) return {};
  const VectorXd without = errorsOf(fitted, unseen, columns - kLags - 1),
                 with = errorsOf(fitted, unseen, columns);
  return PredictionGain{1 - with.sum() / without.sum(), pairedT(without, with)};
}

double predictedGrowth(const SimulationData& data) {
  constexpr Index kColumns = 2 * kLags + 2;  // a constant, past outputs and inputs
  std::vector<VectorXd> none;
  for (const SimulationWindow& window : data.windows)
    none.push_back(VectorXd::Zero(window.samples()));
  const Regression fitted = regressionOf(data, none, none, kLags);
  if (fitted.rows.rows() < kRowsPerColumn * kColumns) return 0;
  const VectorXd past = coefficientsOf(fitted, kColumns).segment(1, kLags);
  const Eigen::VectorXcd poles = roots(-past.reverse());
  double largest = 0;
  for (Index k = 0; k < poles.size(); ++k)
    if (std::abs(poles[k].imag()) < 1e-9) largest = std::max(largest, poles[k].real());
  return largest;
}

}  // namespace uncertainty_identification
