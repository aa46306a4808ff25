#include "estimation/standard_errors.h"

#include <cmath>
#include <limits>

#include "estimation/expected_information.h"
#include "math/symmetric_eigen.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Eigenvalues smaller than this share of a typical one count as zero (the diagonal is scaled to
/// 1).
constexpr double kSingular = 1e-8;

/// The same of the expected information, which needs no differences. Coefficients of a numerator
/// that a smooth input hardly tells apart are determined all the same.
constexpr double kSingularExpected = 1e-12;

/// Eigenvalues smaller than this share may be wrong because of the finite differences, and are
/// computed again along their direction.
constexpr double kSuspicious = 1e-6;

/// Share of the largest one from which a coordinate takes part in a direction.
constexpr double kInvolved = 0.05;

const char* const kNotFinite =
    "no standard errors: the curvature of the log-likelihood at the estimate is not finite; check "
    "the units of u and y, or lower the orders";

/// Text of a warning, e.g. "b1, mean1[1] and mean2[1] cannot be told apart: ..."
std::string sentence(const VectorXd& shares, const std::vector<std::string>& names) {
  std::vector<std::string> involved;
  for (Index k = 0; k < shares.size(); ++k) {
    if (shares[k] > kInvolved) involved.push_back(names[static_cast<std::size_t>(k)]);
  }
  std::string list;
  for (std::size_t k = 0; k < involved.size(); ++k) {
    list += (k == 0 ? "" : (k + 1 == involved.size() ? " and " : ", ")) + involved[k];
  }
  if (involved.size() == 1) {
    return list +
           " cannot be determined from these data: the likelihood does not change with it; fix it, "
           "or record experiments that excite it";
  }
  return list +
         " cannot be told apart: the data determine only a combination of them; constrain the "
         "error model (zero_static_gain or zero_mean), lower the orders, or record experiments "
         "that separate them";
}

/// Sets the covariances of coordinates at the edge of their domain or in a singular direction to
/// NaN.
void mark(const std::vector<bool>& unknown, MatrixXd* covariance) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    if (!unknown[k]) continue;
    covariance->row(static_cast<Index>(k)).setConstant(nan);
    covariance->col(static_cast<Index>(k)).setConstant(nan);
  }
}

/// Curvature of the log-likelihood along a direction, by differences of the gradient extrapolated
/// to step width zero. Four sweeps.
double curvature(const Likelihood& likelihood, const Parametrisation& parametrisation,
                 const ScoredPoint& at, const VectorXd& direction) {
  constexpr double kStep = 1e-2;
  const auto slope = [&](double distance) {
    const VectorXd there = at.coordinates + distance * direction;
    const VectorXd gradient = scoredPoint(likelihood, parametrisation, there).gradient;
    return gradient.size() > 0 ? direction.dot(gradient) : std::numeric_limits<double>::quiet_NaN();
  };
  const auto difference = [&](double step) { return (slope(-step) - slope(step)) / (2 * step); };
  return (4 * difference(kStep / 2) - difference(kStep)) / 3;
}

/// Measures how strongly the data determine the coordinates along a direction.
class DirectionStrength {
 public:
  DirectionStrength(const Likelihood& likelihood, const Parametrisation& parametrisation,
                    const ScoredPoint& point)
      : likelihood_(likelihood),
        parametrisation_(parametrisation),
        point_(point),
        of_model_(expectedModelInformation(likelihood, parametrisation, point,
                                           likelihood.expect(point.statistics, point.parameters))) {
  }

  /// The curvature along `direction`, given as an eigenvalue of the scaled information and its
  /// eigenvector; 0 where the data do not determine it.
  double operator()(double eigenvalue, const VectorXd& eigenvector,
                    const VectorXd& direction) const {
    const double strength = std::abs(eigenvalue) < kSuspicious
                                ? curvature(likelihood_, parametrisation_, point_, direction)
                                : eigenvalue;
    if (strength > kSingular) return strength;
    const double known = expected(eigenvector, direction);
    return known > kSingularExpected ? known : 0;
  }

 private:
  /// The expected information along a direction that leaves the mixture unchanged; 0 for others,
  /// because it does not know how parameters and the spread of xi trade off.
  double expected(const VectorXd& eigenvector, const VectorXd& direction) const {
    constexpr double kOutsideMixture = 0.03;
    const Index p = of_model_.rows(), last = direction.size() - 1;
    if (eigenvector.segment(p, last - p).norm() > kOutsideMixture) return 0;
    const VectorXd of_parameters = direction.head(p);
    return of_parameters.dot(of_model_ * of_parameters) +
           0.5 * point_.statistics.samples().sum() * direction[last] * direction[last];
  }

  const Likelihood& likelihood_;
  const Parametrisation& parametrisation_;
  const ScoredPoint& point_;
  MatrixXd of_model_;
};

/// The inverse of the observed information, without the directions that the data do not determine.
struct InvertedInformation {
  MatrixXd inverse;
  std::vector<std::string> singular;  ///< a sentence for each parameter that is left out alone
  std::vector<bool> unknown;          ///< natural coordinates that the directions left out move
  VectorXd together{};  ///< largest share of each natural coordinate in a direction of several

  /// Leaves out a direction that changes the natural coordinates by `relative`, in standard errors
  /// of each alone.
  void leaveOut(const VectorXd& relative, const std::vector<std::string>& names) {
    const VectorXd shares = relative.cwiseAbs() / relative.cwiseAbs().maxCoeff();
    if ((shares.array() > kInvolved).count() < 2)
      singular.push_back(sentence(shares, names));
    else
      together = together.size() == 0 ? shares : VectorXd(together.cwiseMax(shares));
    for (std::size_t i = 0; i < unknown.size(); ++i) {
      if (std::abs(relative[static_cast<Index>(i)]) > 1e-3 * relative.cwiseAbs().maxCoeff())
        unknown[i] = true;
    }
  }
};

InvertedInformation invert(const Likelihood& likelihood, const Parametrisation& parametrisation,
                           const ScoredPoint& point, const MatrixXd& jacobian) {
  const auto natural = static_cast<std::size_t>(parametrisation.naturalSize());
  const Index size = parametrisation.size();
  const MatrixXd information = observedInformation(likelihood, parametrisation, point, true);
  if (!information.allFinite())
    return {MatrixXd::Zero(size, size), {kNotFinite}, std::vector<bool>(natural, true)};
  InvertedInformation result{MatrixXd::Zero(size, size), {}, std::vector<bool>(natural, false)};
  const VectorXd scale = (information.diagonal().cwiseAbs().array() + 1e-300).rsqrt();
  const SymmetricEigen eigen(scale.asDiagonal() * information * scale.asDiagonal());
  const DirectionStrength strengthOf(likelihood, parametrisation, point);
  // Standard errors of the natural coordinates if all others were known: the unit of changes.
  const VectorXd alone = (jacobian * scale.asDiagonal()).rowwise().norm().cwiseMax(1e-300);
  for (Index k = 0; k < size; ++k) {
    const VectorXd of_unit = eigen.eigenvectors().col(k), direction = scale.cwiseProduct(of_unit);
    const double strength = strengthOf(eigen.eigenvalues()[k], of_unit, direction);
    if (strength > 0) {
      result.inverse += direction * direction.transpose() / strength;
    } else {
      result.leaveOut((jacobian * direction).cwiseQuotient(alone), parametrisation.naturalNames());
    }
  }
  if (result.together.size() > 0)
    result.singular.push_back(sentence(result.together, parametrisation.naturalNames()));
  return result;
}

/// What is reported where the likelihood is not finite: no errors at all.
StandardErrors noErrors(Index natural, Index size) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  StandardErrors errors;
  errors.covariance = errors.robust_covariance = MatrixXd::Constant(natural, natural, kNone);
  errors.coordinate_covariance = errors.robust_coordinate_covariance =
      MatrixXd::Constant(size, size, kNone);
  return errors;
}

/// Scores of parts of the data as those of all natural coordinates. The parameters that were
/// estimated take as many degrees of freedom from them.
MatrixXd ofParts(const MatrixXd& scores, Index natural) {
  const Index p = scores.rows() - 1;
  const auto parts = static_cast<double>(scores.cols());
  MatrixXd all = MatrixXd::Zero(natural, scores.cols());
  all.topRows(p) = scores.topRows(p);
  all.bottomRows(1) = scores.bottomRows(1);
  return all * std::sqrt(parts / (parts - static_cast<double>(scores.rows())));
}

}  // namespace

StandardErrors standardErrors(const Likelihood& likelihood, const Parametrisation& parametrisation,
                              const ModelParameters& at, const MatrixXd& scores) {
  const ScoredPoint point =
      scoredPoint(likelihood, parametrisation, parametrisation.toCoordinates(at));
  const Index natural = parametrisation.naturalSize(), size = parametrisation.size();
  if (!std::isfinite(point.log_likelihood)) return noErrors(natural, size);
  MatrixXd jacobian = parametrisation.jacobian(point.coordinates);
  InvertedInformation information = invert(likelihood, parametrisation, point, jacobian);
  const MatrixXd& inverse = information.inverse;
  std::vector<bool>& unknown = information.unknown;
  jacobian.row(natural - 1) *= at.noise_variance;  // from log sigma^2 to sigma^2
  for (Index i = 0; i < natural; ++i) {
    const bool fixed = jacobian.row(i).isZero(0);
    const bool constant_weight =
        likelihood.model().regressors() == 0 || at.mixture.components() == 1;
    if (fixed && !constant_weight) unknown[static_cast<std::size_t>(i)] = true;
  }
  const bool in_parts = likelihood.experiments() <= size && scores.cols() > size;
  const MatrixXd natural_scores =
      in_parts ? ofParts(scores, natural) : MatrixXd(point.natural_scores);
  const MatrixXd coordinate_scores =
      parametrisation.jacobian(point.coordinates).transpose() * natural_scores;
  StandardErrors errors;
  errors.singular = std::move(information.singular);
  errors.coordinate_covariance = inverse;
  errors.robust_coordinate_covariance =
      inverse * (coordinate_scores * coordinate_scores.transpose()) * inverse;
  errors.covariance = jacobian * inverse * jacobian.transpose();
  errors.robust_covariance = jacobian * errors.robust_coordinate_covariance * jacobian.transpose();
  mark(unknown, &errors.covariance);
  // With fewer experiments than coordinates the scores do not span all directions, and the sandwich
  // would be too small.
  if (likelihood.experiments() <= size && !in_parts) unknown.assign(unknown.size(), true);
  mark(unknown, &errors.robust_covariance);
  return errors;
}

}  // namespace uncertainty_identification
