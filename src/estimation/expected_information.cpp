#include "estimation/expected_information.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Posterior mean of xi over all components, with the mean posterior covariance of one component.
/// The distance between the components, which latentMoments() adds to it, can exceed what the
/// samples leave open, and the Gauss-Newton information would be negative.
LatentMoments momentsWithinComponents(const Expectation& of_point) {
  LatentMoments moments = latentMoments(of_point);
  const Index kappa = of_point.responsibilities.rows();
  for (Index r = 0; r < moments.covariances.cols(); ++r) {
    moments.covariances.col(r) =
        of_point.covariances.middleCols(r * kappa, kappa) * of_point.responsibilities.col(r);
  }
  return moments;
}

/// Sum over the experiments of the information about xi that their samples hold when the component
/// is known: the inverse of Gamma + sigma^2 S^-1, each weighted with the component's
/// responsibility.
MatrixXd informationAboutError(const ScoredPoint& point, const Expectation& of_point,
                               Index component) {
  const Index n = point.statistics.regressors(), kappa = of_point.responsibilities.rows();
  const double variance = point.parameters.noise_variance;
  MatrixXd sum = MatrixXd::Zero(n, n);
  for (int r = 0; r < point.statistics.experiments(); ++r) {
    const MatrixXd S = point.statistics.gram(r).topLeftCorner(n, n);
    const Eigen::Map<const MatrixXd> posterior(
        of_point.covariances.col(r * kappa + component).data(), n, n);
    sum += of_point.responsibilities(component, r) * (S - S * posterior * S / variance) / variance;
  }
  return sum;
}

MatrixXd symmetric(const VectorXd& lower_entries, Index n) {
  const MatrixXd lower = lowerTriangle(lower_entries, n);
  MatrixXd whole = lower + lower.transpose();
  whole.diagonal() = lower.diagonal();
  return whole;
}

/// Information of one component about the coordinates whose changes of [weights; means;
/// covariances] are the columns of `change`.
VectorXd informationOfComponent(const MatrixXd& change, const ScoredPoint& point,
                                const Expectation& of_point, Index component) {
  const Index n = point.statistics.regressors(), kappa = of_point.responsibilities.rows();
  const Index triangle = n * (n + 1) / 2;
  const double members = of_point.responsibilities.row(component).sum();
  if (!(members > 0)) return VectorXd::Zero(change.cols());
  const double weight = point.parameters.mixture.weights[static_cast<std::size_t>(component)];
  const MatrixXd A = informationAboutError(point, of_point, component);
  VectorXd information(change.cols());
  for (Index j = 0; j < change.cols(); ++j) {
    const VectorXd column = change.col(j);
    const VectorXd mean = column.segment(kappa + component * n, n);
    const MatrixXd moved =
        A * symmetric(column.segment(kappa + kappa * n + component * triangle, triangle), n);
    const double relative = column[component] / weight;
    // The covariance enters by tr((A dGamma)^2)/2 for each member.
    information[j] = members * relative * relative + mean.dot(A * mean) +
                     0.5 * (moved * moved).trace() / members;
  }
  return information;
}

}  // namespace

MatrixXd expectedModelInformation(const Likelihood& likelihood,
                                  const Parametrisation& parametrisation, const ScoredPoint& point,
                                  const Expectation& of_point) {
  const Index p = parametrisation.modelCoordinates();
  if (p == 0) return MatrixXd(0, 0);
  const MatrixXd natural =
      likelihood.information(point.parameters, momentsWithinComponents(of_point))
          .observed.topLeftCorner(p, p);
  const MatrixXd J = likelihood.model().unboundedJacobian(point.coordinates.head(p));
  return J.transpose() * natural * J;
}

VectorXd expectedMixtureInformation(const Parametrisation& parametrisation,
                                    const ScoredPoint& point, const Expectation& of_point) {
  const Index p = parametrisation.modelCoordinates();
  const Index coordinates = point.coordinates.size() - p - 1;
  VectorXd information = VectorXd::Zero(coordinates);
  if (point.statistics.regressors() == 0) return information;
  const MatrixXd jacobian = parametrisation.jacobian(point.coordinates);
  const MatrixXd change = jacobian.block(p, p, jacobian.rows() - p - 1, coordinates);
  for (Index i = 0; i < of_point.responsibilities.rows(); ++i)
    information += informationOfComponent(change, point, of_point, i);
  return information.cwiseMax(0);
}

}  // namespace uncertainty_identification
