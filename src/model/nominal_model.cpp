#include "uncertainty_identification/model/nominal_model.h"

#include <cmath>

#include "math/polynomial.h"
#include "model/box_jenkins.h"
#include "model/central_differences.h"
#include "model/continuous.h"
#include "model/modal.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

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
                            theta, theta.size());
}

Eigen::MatrixXd NominalModel::unboundedJacobian(const Eigen::VectorXd& unbounded) const {
  return centralDifferences([this](const Eigen::VectorXd& at) { return fromUnbounded(at); },
                            unbounded, unbounded.size());
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
  switch (options.structure) {
    case Structure::continuous:
      return makeContinuous(options, sample_time);
    case Structure::modal:
      return makeModal(options, sample_time);
    default:
      return makeBoxJenkins(options);
  }
}

}  // namespace uncertainty_identification
