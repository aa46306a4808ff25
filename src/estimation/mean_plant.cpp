#include "estimation/mean_plant.h"

namespace uncertainty_identification {

Polynomials filteredPlant(Polynomials plant, const Eigen::MatrixXd& T, const Eigen::VectorXd& xi) {
  constexpr double kRounding = 1e-12;
  Eigen::VectorXd factor = T * xi;
  if (factor.size() == 0 || factor.cwiseAbs().maxCoeff() < kRounding) return plant;
  factor[0] += 1;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(plant.b.size() + factor.size() - 1);
  for (Eigen::Index k = 0; k < factor.size(); ++k)
    b.segment(k, plant.b.size()) += factor[k] * plant.b;
  plant.b = b;
  return plant;
}

Polynomials meanPlant(const Estimate& estimate) {
  const NominalModelEstimate& go = estimate.nominal_model;
  const ErrorModelEstimate& errors = estimate.error_model;
  const Polynomials plant{go.delay, go.b, go.a, {}, {}};
  if (errors.options.basis != BasisKind::fir || errors.T.cols() == 0) return plant;
  return filteredPlant(plant, errors.T, errors.mixture.mean());
}

}  // namespace uncertainty_identification
