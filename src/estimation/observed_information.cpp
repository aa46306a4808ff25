#include "estimation/observed_information.h"

#include <cmath>
#include <limits>

#include "estimation/expected_information.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void score(const Likelihood& likelihood, const Parametrisation& parametrisation,
           ScoredPoint* point) {
  const Expectation e = likelihood.expect(point->statistics, point->parameters);
  point->log_likelihood = e.total();
  point->natural_scores = scores(point->statistics, point->parameters, e);
  point->gradient = parametrisation.jacobian(point->coordinates).transpose() *
                    point->natural_scores.rowwise().sum();
}

/// About the information of each coordinate alone: the larger of the expected one and of the outer
/// product of the scores. The latter knows what the spread of xi tells about the model's
/// parameters, but is zero at the maximum of a single experiment.
VectorXd informationScale(const Likelihood& likelihood, const Parametrisation& parametrisation,
                          const ScoredPoint& at) {
  const Expectation e = likelihood.expect(at.statistics, at.parameters);
  VectorXd expected(at.coordinates.size());
  expected << expectedModelInformation(likelihood, parametrisation, at, e).diagonal(),
      expectedMixtureInformation(parametrisation, at, e), 0.5 * at.statistics.samples().sum();
  const MatrixXd of_experiments =
      parametrisation.jacobian(at.coordinates).transpose() * at.natural_scores;
  const VectorXd mean = of_experiments.rowwise().mean();
  return expected.cwiseMax((of_experiments.colwise() - mean).rowwise().squaredNorm());
}

/// A thousandth of a standard error that has this information, or of the coordinate's size where
/// the data tell nothing about it.
double stepWidth(double information, double coordinate) {
  const double width = 1e-3 / std::sqrt(information);
  return std::isfinite(width) && width > 0 ? width : 1e-3 * std::max(1.0, std::abs(coordinate));
}

/// -d gradient/d coordinate from the gradients at a point and `step` below and above it; empty
/// where neither neighbour has one. One neighbour suffices.
VectorXd curvatureColumn(const VectorXd& low, const VectorXd& here, const VectorXd& high,
                         double step) {
  const auto known = [&](const VectorXd& g) { return g.size() == here.size() && g.allFinite(); };
  if (known(low) && known(high)) return (low - high) / (2 * step);
  if (known(high)) return (here - high) / step;
  if (known(low)) return (low - here) / step;
  return {};
}

/// The gradient where coordinate j is moved by `distance`; empty outside the model's domain.
VectorXd gradientBeside(const Likelihood& likelihood, const Parametrisation& parametrisation,
                        const ScoredPoint& at, Index j, double distance) {
  VectorXd there = at.coordinates;
  there[j] += distance;
  if (j < parametrisation.modelCoordinates())
    return scoredPoint(likelihood, parametrisation, there).gradient;
  ScoredPoint moved;
  moved.coordinates = there;
  moved.parameters = parametrisation.fromCoordinates(there);
  moved.statistics = at.statistics;
  score(likelihood, parametrisation, &moved);
  return moved.gradient;
}

/// The symmetric matrix whose elements are the mean of those of its two columns that are known
/// (`known` is 1 or 0; unknown columns are 0). `diagonal` is used where a column is unknown.
MatrixXd symmetricFrom(const MatrixXd& columns, const VectorXd& known, const VectorXd& diagonal) {
  const Index size = known.size();
  const MatrixXd counts = known.replicate(1, size) + known.transpose().replicate(size, 1);
  MatrixXd result = (columns + columns.transpose()).cwiseQuotient(counts.cwiseMax(1));
  result.diagonal() += (1 - known.array()).matrix().cwiseProduct(diagonal);
  return result;
}

}  // namespace

ScoredPoint scoredPoint(const Likelihood& likelihood, const Parametrisation& parametrisation,
                        const VectorXd& coordinates) {
  ScoredPoint point;
  point.coordinates = coordinates;
  point.log_likelihood = -std::numeric_limits<double>::infinity();
  if (!coordinates.allFinite()) return point;
  point.parameters = parametrisation.fromCoordinates(coordinates);
  const bool sane = point.parameters.noise_variance > 0 &&
                    std::isfinite(point.parameters.noise_variance) &&
                    point.parameters.mixture.weights.size() > 0;
  for (double weight : point.parameters.mixture.weights) {
    if (!(weight > 0)) return point;
  }
  if (!sane || !likelihood.model().admissible(point.parameters.parameters)) return point;
  point.statistics = likelihood.statistics(point.parameters.parameters, true);
  score(likelihood, parametrisation, &point);
  if (!std::isfinite(point.log_likelihood))
    point.log_likelihood = -std::numeric_limits<double>::infinity();
  return point;
}

MatrixXd observedInformation(const Likelihood& likelihood, const Parametrisation& parametrisation,
                             const ScoredPoint& at, bool central) {
  const Index size = at.coordinates.size();
  const VectorXd scale = informationScale(likelihood, parametrisation, at);
  MatrixXd columns = MatrixXd::Zero(size, size);
  VectorXd known = VectorXd::Zero(size);
  for (Index j = 0; j < size; ++j) {
    const double step = stepWidth(scale[j], at.coordinates[j]);
    const auto beside = [&](double distance) {
      return gradientBeside(likelihood, parametrisation, at, j, distance);
    };
    const VectorXd high = beside(step);
    const VectorXd low = central || high.size() == 0 ? beside(-step) : VectorXd();
    const VectorXd column = curvatureColumn(low, at.gradient, high, step);
    if (column.size() == 0) continue;
    columns.col(j) = column;
    known[j] = 1;
  }
  return symmetricFrom(columns, known, scale);
}

}  // namespace uncertainty_identification
