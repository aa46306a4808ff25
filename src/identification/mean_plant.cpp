#include "identification/mean_plant.h"

#include <algorithm>
#include <cmath>

#include "model/fixed_plant.h"

namespace uncertainty_identification {

Polynomials meanPlant(const StructureFit& fit) {
  Polynomials plant = fit.start().polynomials;
  const ErrorBasis& basis = fit.model->basis();
  if (basis.kind() != BasisKind::fir || basis.dimension() == 0) return plant;
  Eigen::VectorXd factor = basis.T() * fit.point.mixture.mean();
  factor[0] += 1;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(plant.b.size() + factor.size() - 1);
  for (Eigen::Index k = 0; k < factor.size(); ++k)
    b.segment(k, plant.b.size()) += factor[k] * plant.b;
  plant.b = b;
  return plant;
}

SimulationFit fitOf(const Problem& problem, const Polynomials& plant, double offset) {
  return simulationFit(*fixPlant(plant, 0, 0), Eigen::VectorXd(0), offset,
                       problem.configuration.estimation, problem.data.experiments,
                       InitialValuesFrom::all_samples);
}

bool simulatesWorse(const SimulationFit& one, const SimulationFit& other) {
  constexpr double kErrors = 2, kTolerance = 0.5;  // standard errors; [% of fit]
  if (one.pooled >= other.pooled - kTolerance) return false;
  double count = 0, sum = 0, squares = 0;
  for (std::size_t r = 0; r < one.percent.size(); ++r) {
    const double more = std::pow(100 - one.percent[r], 2) - std::pow(100 - other.percent[r], 2);
    if (!std::isfinite(more)) continue;
    ++count;
    sum += more;
    squares += more * more;
  }
  if (count < 4) return true;
  const double variance = std::max(0.0, squares - sum * sum / count) / (count - 1);
  return sum / count > kErrors * std::sqrt(variance / count);
}

}  // namespace uncertainty_identification
