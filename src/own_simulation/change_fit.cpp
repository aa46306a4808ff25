#include "own_simulation/change_fit.h"

#include <Eigen/LU>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "curves/window_products.h"

namespace uncertainty_identification {
namespace {

using Block = WindowProducts::Block;

/// Residual of a run and its derivatives, transients taken out of both.
struct RunResidual {
  Eigen::VectorXd error;
  Eigen::MatrixXd slopes;
};

RunResidual residualOf(const ChangedSimulation& simulation, const ComparedRun& run,
                       const Changes& changes, bool with_slopes) {
  RunResidual residual;
  const Eigen::VectorXd y = simulation.output(run, changes);
  residual.error = (run.weight > 0).select(run.experiment->y - y, 0.0);
  const Eigen::MatrixXd transient =
      run.weight.matrix().asDiagonal() * transientOf(changes, y.size());
  if (with_slopes)
    residual.slopes = run.weight.matrix().asDiagonal() * simulation.derivatives(run, changes);
  if (transient.cols() > 0 && transient.norm() > 0 && residual.error.allFinite()) {
    const Eigen::MatrixXd basis = orthonormal(transient);
    residual.error -= basis * (basis.transpose() * residual.error).eval();
    if (with_slopes) residual.slopes -= basis * (basis.transpose() * residual.slopes).eval();
  }
  return residual;
}

/// Products of all units, and their sums.
struct Normal {
  std::vector<Block> units;
  Eigen::MatrixXd jj;
  Eigen::VectorXd jr;
  double rr = 0;
};

Normal linearised(const ChangedSimulation& simulation, const ComparedData& data,
                  const Changes& changes) {
  Normal normal;
  const Eigen::Index count = estimatedCoordinates(changes);
  normal.jj = Eigen::MatrixXd::Zero(count, count);
  normal.jr = Eigen::VectorXd::Zero(count);
  for (const ComparedRun& run : data.runs) {
    const RunResidual residual = residualOf(simulation, run, changes, true);
    for (std::size_t b = 0; b + 1 < run.blocks.size(); ++b) {
      const int begin = run.blocks[b], length = run.blocks[b + 1] - begin;
      const Eigen::MatrixXd slopes = residual.slopes.middleRows(begin, length);
      const Eigen::VectorXd error = residual.error.segment(begin, length);
      Block unit;
      unit.jj = slopes.transpose() * slopes;
      unit.jr = slopes.transpose() * error;
      unit.rr = error.squaredNorm();
      normal.jj += unit.jj;
      normal.jr += unit.jr;
      normal.rr += unit.rr;
      normal.units.push_back(std::move(unit));
    }
  }
  return normal;
}

Eigen::VectorXd solvedBy(const Eigen::MatrixXd& information, const Eigen::VectorXd& right,
                         double damping) {
  if (right.size() == 0) return right;
  Eigen::MatrixXd damped = information;
  damped.diagonal() *= 1 + damping;
  damped.diagonal().array() += 1e-300;
  const Eigen::VectorXd step = damped.fullPivLu().solve(right);
  return step.allFinite() ? step : Eigen::VectorXd::Zero(right.size());
}

/// Leaving units out of the linearised fit after `step`, and the sandwich covariance.
ChangeFit concluded(const Normal& normal, Changes changes, const Eigen::VectorXd& step) {
  ChangeFit fit;
  fit.changes = std::move(changes);
  const auto count = static_cast<double>(normal.units.size());
  fit.left_out_of.resize(static_cast<Eigen::Index>(normal.units.size()));
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(normal.jj.rows(), normal.jj.cols());
  for (std::size_t k = 0; k < normal.units.size(); ++k) {
    const Block& unit = normal.units[k];
    const Eigen::VectorXd gradient = unit.jr - unit.jj * step;
    const Eigen::VectorXd without = step - solvedBy(normal.jj - unit.jj, gradient, 1e-9);
    fit.left_out_of[static_cast<Eigen::Index>(k)] = std::max(errorAfter(unit, without), 0.0);
    fit.squared_error += errorAfter(unit, step);
    spread += gradient * gradient.transpose();
  }
  if (normal.jj.rows() > 0) {
    const Eigen::MatrixXd inverse = normal.jj.fullPivLu().inverse();
    fit.covariance = count / std::max(count - 1, 1.0) * (inverse * spread * inverse);
  }
  return fit;
}

/// What stands for a fit for which no runs are left: its error is infinite.
ChangeFit noFit(const Changes& changes) {
  ChangeFit fit;
  fit.changes = changes;
  fit.squared_error = std::numeric_limits<double>::infinity();
  fit.left_out_of = Eigen::VectorXd::Constant(1, fit.squared_error);
  return fit;
}

std::size_t runsForDerivatives(const ComparedData& data, const Changes& changes) {
  std::size_t parameters = 0;
  for (const Change& change : changes) parameters += change.kind == ChangeKind::parameter;
  return data.runs.size() * (parameters > 0 ? parameters + 1 : 0);
}

/// Long-run variance of the sum of a series, by Bartlett's weights.
double varianceOfSum(const Eigen::VectorXd& series) {
  const Eigen::Index lags = static_cast<Eigen::Index>(2 * std::cbrt(series.size()));
  double sum = series.squaredNorm();
  for (Eigen::Index lag = 1; lag <= std::min(lags, series.size() - 1); ++lag)
    sum += 2 * (1 - static_cast<double>(lag) / static_cast<double>(lags + 1)) *
           series.head(series.size() - lag).dot(series.tail(series.size() - lag));
  return std::max(sum, 0.2 * series.squaredNorm());
}

/// What an experiment alone says about each coordinate: its own values and their variances.
struct OwnCoordinates {
  Eigen::VectorXd at, variance;
};

OwnCoordinates ownCoordinates(const RunResidual& residual) {
  const Eigen::MatrixXd information = residual.slopes.transpose() * residual.slopes;
  const Eigen::MatrixXd inverse = information.fullPivLu().inverse();
  OwnCoordinates own;
  own.at = inverse * (residual.slopes.transpose() * residual.error);
  const Eigen::VectorXd left = residual.error - residual.slopes * own.at;
  own.variance.resize(own.at.size());
  const Eigen::MatrixXd influence = residual.slopes * inverse;
  for (Eigen::Index k = 0; k < own.at.size(); ++k)
    own.variance[k] = varianceOfSum(influence.col(k).cwiseProduct(left));
  return own;
}

}  // namespace

Eigen::VectorXd errorsOf(const ChangedSimulation& simulation, const ComparedData& data,
                         const Changes& changes) {
  std::vector<double> errors;
  for (const ComparedRun& run : data.runs) {
    const RunResidual residual = residualOf(simulation, run, changes, false);
    for (std::size_t b = 0; b + 1 < run.blocks.size(); ++b)
      errors.push_back(
          residual.error.segment(run.blocks[b], run.blocks[b + 1] - run.blocks[b]).squaredNorm());
  }
  return Eigen::Map<Eigen::VectorXd>(errors.data(), static_cast<Eigen::Index>(errors.size()));
}

ChangeFit stepOnce(const ChangedSimulation& simulation, const ComparedData& data,
                   const Changes& changes) {
  const Normal normal = linearised(simulation, data, changes);
  const Eigen::VectorXd step = solvedBy(normal.jj, normal.jr, 1e-9);
  return concluded(normal, moved(changes, step), step);
}

ChangeFit fitChanges(const ChangedSimulation& simulation, const ComparedData& data,
                     Changes changes) {
  if (!simulation.runs().affords(runsForDerivatives(data, changes))) return noFit(changes);
  constexpr int kMostIterations = 8;
  constexpr double kTolerance = 1e-4, kLargest = 0.7;  // a factor of two of a positive parameter
  constexpr double kNegligible = 1e-6;  // of the squared error: far below what noise adds to it
  Normal at = linearised(simulation, data, changes);
  double damping = 1e-6;
  for (int k = 0; k < kMostIterations && changes.size() > 0; ++k) {
    const double before = at.rr;
    for (int attempt = 0; attempt < 5; ++attempt, damping = std::max(damping, 1e-3) * 10) {
      if (!simulation.runs().affords(runsForDerivatives(data, changes))) break;
      Eigen::VectorXd step = solvedBy(at.jj, at.jr, damping);
      Eigen::Index first = 0;
      for (const Change& change : changes) {
        if (change.kind == ChangeKind::parameter && simulation.keepsSign(change.parameter))
          step[first] = std::min(std::max(step[first], -kLargest), kLargest);
        first += change.estimated();
      }
      const double promised = step.dot(2 * at.jr - at.jj * step);
      if (promised < kNegligible * at.rr) break;
      const Changes candidate = moved(changes, step);
      const double error = errorsOf(simulation, data, candidate).sum();
      if (!(error < at.rr)) continue;
      changes = candidate;
      at = linearised(simulation, data, changes);
      damping = std::max(damping / 10, 1e-9);
      break;
    }
    if (!(at.rr < (1 - kTolerance) * before)) break;
  }
  return concluded(at, changes, Eigen::VectorXd::Zero(at.jr.size()));
}

std::vector<RunSpread> spreadOf(const ChangedSimulation& simulation, const ComparedData& data,
                                const Changes& changes) {
  constexpr std::size_t kFewest = 5;
  const Eigen::Index count = estimatedCoordinates(changes);
  std::vector<RunSpread> spreads(static_cast<std::size_t>(count));
  if (data.runs.size() < kFewest || count == 0) return spreads;
  std::vector<OwnCoordinates> own;
  for (const ComparedRun& run : data.runs) {
    own.push_back(ownCoordinates(residualOf(simulation, run, changes, true)));
    if (!own.back().at.allFinite()) return spreads;
  }
  const auto runs = static_cast<double>(own.size());
  for (Eigen::Index k = 0; k < count; ++k) {
    double weights = 0, mean = 0, excess = 0, plain = 0, noise = 0, plain_mean = 0;
    for (const OwnCoordinates& each : own) {
      weights += 1 / each.variance[k];
      mean += each.at[k] / each.variance[k];
      plain_mean += each.at[k] / runs;
    }
    mean /= weights;
    for (const OwnCoordinates& each : own) {
      excess += (each.at[k] - mean) * (each.at[k] - mean) / each.variance[k];
      plain += (each.at[k] - plain_mean) * (each.at[k] - plain_mean) / (runs - 1);
      noise += each.variance[k] / runs;
    }
    RunSpread& spread = spreads[static_cast<std::size_t>(k)];
    spread.deviation = std::sqrt(std::max(plain - noise, 0.0));
    const boost::math::chi_squared none(runs - 1);
    spread.significant =
        std::isfinite(excess) && plain > 2 * noise && excess > boost::math::quantile(none, 0.999);
  }
  return spreads;
}

}  // namespace uncertainty_identification
