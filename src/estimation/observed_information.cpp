#include "estimation/observed_information.h"

#include <cmath>
#include <limits>

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

/// Step widths of about a thousandth of each coordinate's standard error. The scale is taken from
/// the outer product of the scores, or from the complete-data information where there are too few
/// experiments for that.
VectorXd steps(const Parametrisation& parametrisation, const ScoredPoint& at) {
  const MatrixXd of_experiments =
      parametrisation.jacobian(at.coordinates).transpose() * at.natural_scores;
  const Index last = at.coordinates.size() - 1;
  const double experiments = static_cast<double>(of_experiments.cols());
  VectorXd scale = of_experiments.rowwise().squaredNorm();
  scale[last] = std::max(scale[last], 0.5 * at.statistics.samples().sum());
  VectorXd result(scale.size());
  for (Index j = 0; j < scale.size(); ++j) {
    const double natural = j < parametrisation.modelCoordinates() ? at.coordinates[j] : 1.0;
    const double information = std::max(scale[j], experiments * 1e-4 / (natural * natural + 1e-12));
    result[j] = 1e-3 / std::sqrt(information);
  }
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
  const VectorXd step = steps(parametrisation, at);
  const auto gradientAt = [&](Index j, double distance) -> VectorXd {
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
  };
  MatrixXd information = MatrixXd::Zero(size, size);
  for (Index j = 0; j < size; ++j) {
    const VectorXd high = gradientAt(j, step[j]);
    const VectorXd low = central ? gradientAt(j, -step[j]) : at.gradient;
    if (high.size() != size || low.size() != size)
      continue;  // at the edge of the domain: the curvature is not known
    information.col(j) = (low - high) / (central ? 2 * step[j] : step[j]);
  }
  return 0.5 * (information + information.transpose());
}

}  // namespace uncertainty_identification
