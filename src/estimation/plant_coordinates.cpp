#include "estimation/plant_coordinates.h"

#include <Eigen/LU>

#include "math/polynomial.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd plantCoordinates(const VectorXd& b, const VectorXd& a) {
  VectorXd coordinates(b.size() + a.size());
  coordinates << b, toUnbounded(a);
  return coordinates;
}

MatrixXd plantCoordinatesJacobian(const NominalModel& nominal, const VectorXd& theta) {
  const Polynomials p = nominal.polynomials(theta);
  const Index nb = p.b.size(), na = p.a.size();
  const MatrixXd to_polynomials =
      nominal.jacobian(theta) * nominal.unboundedJacobian(nominal.toUnbounded(theta));
  MatrixXd jacobian = to_polynomials.topRows(nb + na);
  if (na == 0) return jacobian;
  MatrixXd of_a;
  fromUnbounded(toUnbounded(p.a), &of_a);
  jacobian.bottomRows(na) = of_a.partialPivLu().solve(to_polynomials.middleRows(nb, na));
  return jacobian;
}

}  // namespace uncertainty_identification
