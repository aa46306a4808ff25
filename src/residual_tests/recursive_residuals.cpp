#include "residual_tests/recursive_residuals.h"

#include <cmath>

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Variance over sigma^2 of the coefficients before the first sample: so large that it states
// nothing.
constexpr double kUnknown = 1e8;
// Variance over sigma^2 of a sample's prediction above which the sample only determines the
// coefficients, and is no residual itself.
constexpr double kUndetermined = 1e4;

/// One lane of a signal, which is zero beyond its end.
VectorXd laneOf(const Signals& signal, int lane, Index samples) {
  VectorXd values = VectorXd::Zero(samples);
  const Index known = std::min(samples, signal.cols());
  values.head(known) = signal.row(lane).head(known).transpose();
  return values;
}

/// [Z Phi] of a lane, or its derivative.
MatrixXd columnsOf(const WhitenedSignals& signals, const Response& response, int lane,
                   Index samples) {
  const std::size_t nuisances = response.value.columns.size();
  const std::size_t regressors = response.value.regressors.size();
  MatrixXd columns = MatrixXd::Zero(samples, static_cast<Index>(nuisances + regressors));
  for (std::size_t k = 0; k < signals.columns.size(); ++k) {
    if (signals.columns[k] == nullptr) continue;
    columns.col(static_cast<Index>(k)) = laneOf(*signals.columns[k], lane, samples);
  }
  for (std::size_t k = 0; k < signals.regressors.size(); ++k) {
    columns.col(static_cast<Index>(nuisances + k)) = laneOf(signals.regressors[k], lane, samples);
  }
  return columns;
}

/// Whether each sample is in the likelihood: samples that are missing or left out are zero in all
/// whitened signals.
VectorXd countedSamples(const VectorXd& residual, const MatrixXd& X, const Block& block, int lane) {
  VectorXd counted(residual.size());
  for (Index t = 0; t < residual.size(); ++t) {
    const bool empty = residual[t] == 0 && X.row(t).isZero(0);
    counted[t] = block.weight(lane, t) == 0 || empty ? 0 : 1;
  }
  return counted;
}

/// Innovations of several signals that depend on the same columns, over their standard deviations.
struct Innovations {
  MatrixXd values;        ///< a column for each signal
  VectorXd valid;         ///< 1 at samples that the earlier ones predict
  MatrixXd coefficients;  ///< of the columns, from all samples; a column for each signal
};

/// Recursive least squares with columns X of mean square 1.
Innovations innovationsOf(const MatrixXd& X, const MatrixXd& signals, const VectorXd& counted) {
  MatrixXd P = kUnknown * MatrixXd::Identity(X.cols(), X.cols());
  Innovations result{MatrixXd::Zero(signals.rows(), signals.cols()), VectorXd::Zero(signals.rows()),
                     MatrixXd::Zero(X.cols(), signals.cols())};
  for (Index t = 0; t < signals.rows(); ++t) {
    if (counted[t] == 0) continue;
    const VectorXd Px = P * X.row(t).transpose();
    const double variance = 1 + X.row(t) * Px;
    const Eigen::RowVectorXd innovation = signals.row(t) - X.row(t) * result.coefficients;
    if (variance < kUndetermined) {
      result.values.row(t) = innovation / std::sqrt(variance);
      result.valid[t] = 1;
    }
    result.coefficients += Px * (innovation / variance);
    P -= Px * Px.transpose() / variance;
  }
  return result;
}

}  // namespace

RecursiveResiduals recursiveResiduals(const Response& response, const Block& block, int lane) {
  const Index samples = block.lengths[static_cast<std::size_t>(lane)];
  const VectorXd residual = laneOf(response.value.residual, lane, samples);
  MatrixXd X = columnsOf(response.value, response, lane, samples);
  VectorXd size = X.colwise().norm().transpose() / std::sqrt(static_cast<double>(samples));
  size = (size.array() > 0).select(size, 1.0);
  X = X * size.cwiseInverse().asDiagonal();
  const VectorXd counted = countedSamples(residual, X, block, lane);
  const Innovations of_residual = innovationsOf(X, residual, counted);
  // To first order the residuals follow those of e - [Z Phi] times the coefficients, which stay.
  const VectorXd coefficients = of_residual.coefficients.cwiseQuotient(size);
  MatrixXd derivatives(samples, static_cast<Index>(response.derivatives.size()));
  for (std::size_t j = 0; j < response.derivatives.size(); ++j) {
    const WhitenedSignals& derivative = response.derivatives[j];
    derivatives.col(static_cast<Index>(j)) =
        laneOf(derivative.residual, lane, samples) -
        columnsOf(derivative, response, lane, samples) * coefficients;
  }
  return {of_residual.values, of_residual.valid, innovationsOf(X, derivatives, counted).values};
}

}  // namespace uncertainty_identification
