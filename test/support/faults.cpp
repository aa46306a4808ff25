#include "support/faults.h"

#include <limits>

#include "simulation/simulate.h"

namespace uncertainty_identification::test {
namespace {

using Eigen::VectorXd;

/// Go (1 + GDelta) u of the drawn system, from rest.
VectorXd plantOutput(const Truth& truth, const DrawnSystem& system, const VectorXd& u) {
  const Polynomials& p = system.polynomials;
  VectorXd numerator = VectorXd::Zero(p.delay + p.b.size());
  numerator.tail(p.b.size()) = p.b;
  StreamFilter plant(numerator, p.a);
  const RationalBasis basis{ErrorBasis(truth.error_model.basis)};
  std::vector<StreamFilter> filters;
  for (const VectorXd& one : basis.numerators) filters.emplace_back(one, basis.denominator);
  VectorXd y(u.size());
  for (Eigen::Index t = 0; t < u.size(); ++t) {
    const double x = plant.step(u[t]);
    y[t] = x;
    for (std::size_t i = 0; i < filters.size(); ++i)
      y[t] += system.xi[static_cast<Eigen::Index>(i)] * filters[i].step(x);
  }
  return y;
}

VectorXd faultyInput(const VectorXd& u, const Fault& fault) {
  VectorXd changed = u;
  for (Eigen::Index t = fault.onset; t < u.size(); ++t) {
    const auto late = static_cast<Eigen::Index>(fault.size);
    if (fault.kind == FaultKind::effectiveness) changed[t] *= 1 - fault.size;
    if (fault.kind == FaultKind::delay) changed[t] = t >= late ? u[t - late] : 0;
  }
  return changed;
}

}  // namespace

Estimate estimateOf(const Truth& truth) {
  Estimate estimate;
  estimate.termination = Termination::converged;
  NominalModelOptions& options = estimate.configuration.nominal_model;
  options.nb = static_cast<int>(truth.plant.b.size());
  options.na = static_cast<int>(truth.plant.a.size());
  options.nc = static_cast<int>(truth.noise.c.size());
  options.nd = static_cast<int>(truth.noise.d.size());
  options.delay = truth.plant.delay;
  estimate.configuration.estimation.initial_state = InitialState::zero;
  estimate.configuration.estimation.noise_start = truth.noise.start;
  estimate.configuration.estimation.offsets = Offsets::none;
  NominalModelEstimate& go = estimate.nominal_model;
  go.structure = "box_jenkins";
  go.sample_time = truth.sample_time;
  go.delay = truth.plant.delay;
  go.b = truth.plant.b;
  go.a = truth.plant.a;
  go.c = truth.noise.c;
  go.d = truth.noise.d;
  const VectorXd theta = Polynomials{go.delay, go.b, go.a, go.c, go.d}.stacked();
  for (Eigen::Index k = 0; k < theta.size(); ++k) go.parameters.push_back({"", "", theta[k], 0, 0});
  go.covariance = Eigen::MatrixXd::Zero(theta.size(), theta.size());
  estimate.error_model.options = truth.error_model.basis;
  estimate.error_model.T = ErrorBasis(truth.error_model.basis).T();
  estimate.error_model.mixture = truth.error_model.mixture;
  estimate.noise_variance.value = truth.noise.variance;
  return estimate;
}

Experiment FaultyPlant::experiment(int r, const Fault& fault) const {
  Experiment experiment = simulateExperiment(truth_, seed_, r);
  if (fault.kind == FaultKind::none) return experiment;
  const DrawnSystem system = drawSystem(truth_, seed_, r);
  experiment.y += plantOutput(truth_, system, faultyInput(experiment.u, fault)) -
                  plantOutput(truth_, system, experiment.u);
  if (fault.kind == FaultKind::bias)
    experiment.y.tail(experiment.y.size() - fault.onset).array() += fault.size;
  return experiment;
}

std::vector<FaultWindow> decisions(FaultDetector* detector, const Experiment& experiment) {
  detector->reset();
  std::vector<FaultWindow> all;
  for (int t = 0; t < experiment.samples(); ++t) {
    const double y =
        experiment.isValid(t) ? experiment.y[t] : std::numeric_limits<double>::quiet_NaN();
    if (const auto window = detector->add(experiment.u[t], y)) all.push_back(*window);
  }
  return all;
}

}  // namespace uncertainty_identification::test
