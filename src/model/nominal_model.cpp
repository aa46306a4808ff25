#include "uncertainty_identification/model/nominal_model.h"

#include <cmath>
#include <functional>

#include "math/polynomial.h"
#include "model/box_jenkins.h"
#include "model/continuous.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

Eigen::MatrixXd centralDifferences(
    const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& function,
    const Eigen::VectorXd& at) {
  Eigen::MatrixXd jacobian(function(at).size(), at.size());
  for (Eigen::Index j = 0; j < at.size(); ++j) {
    const double step = 6e-6 * std::max(std::abs(at[j]), 1e-3);  // cube root of the rounding error
    Eigen::VectorXd high = at, low = at;
    high[j] += step;
    low[j] -= step;
    jacobian.col(j) = (function(high) - function(low)) / (high[j] - low[j]);
  }
  return jacobian;
}

}  // namespace

Eigen::VectorXd Polynomials::stacked() const {
  Eigen::VectorXd all(b.size() + a.size() + c.size() + d.size());
  all << b, a, c, d;
  return all;
}

std::vector<std::string> NominalModel::units() const {
  return std::vector<std::string>(names().size());
}

Eigen::MatrixXd NominalModel::jacobian(const Eigen::VectorXd& theta) const {
  return centralDifferences([this](const Eigen::VectorXd& at) { return polynomials(at).stacked(); },
                            theta);
}

Eigen::MatrixXd NominalModel::unboundedJacobian(const Eigen::VectorXd& unbounded) const {
  return centralDifferences([this](const Eigen::VectorXd& at) { return fromUnbounded(at); },
                            unbounded);
}

bool NominalModel::admissible(const Eigen::VectorXd& theta) const {
  if (!theta.allFinite()) return false;
  const Polynomials p = polynomials(theta);
  return p.b.allFinite() && isStable(p.a) && isStable(p.c) && isStable(p.d);
}

Eigen::VectorXd NominalModel::fromPolynomials(const Polynomials&) const {
  throw ConfigurationError("the nominal model '" + structure() +
                           "' cannot choose its own start; give `initial: {theta: [...]}`");
}

std::shared_ptr<const NominalModel> makeNominalModel(const NominalModelOptions& options,
                                                     double sample_time) {
  return options.structure == Structure::continuous ? makeContinuous(options, sample_time)
                                                    : makeBoxJenkins(options);
}

}  // namespace uncertainty_identification
