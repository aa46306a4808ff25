#include "estimation/initial_guess.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>

#include "estimation/excerpt.h"
#include "estimation/least_squares_models.h"
#include "model/continuous.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Residuals of each experiment's regression on x, q^-1 x, q^-2 x and a constant, x = Go u by a
/// start for Go: mostly noise, because the regression takes up most of the error model.
std::vector<VectorXd> noiseResiduals(const std::vector<Experiment>& experiments,
                                     const LeastSquaresModel& start) {
  constexpr std::size_t kMost = 200;
  constexpr Index kTaps = 3;
  std::vector<VectorXd> residuals;
  const std::size_t stride = std::max<std::size_t>(1, experiments.size() / kMost);
  for (std::size_t r = 0; r < experiments.size(); r += stride) {
    const Experiment& experiment = experiments[r];
    if (experiment.validSamples() != experiment.samples() || experiment.samples() < 30) continue;
    const VectorXd x = simulated(start.polynomials, 0, experiment.u);
    MatrixXd regressors = MatrixXd::Ones(x.size(), kTaps + 1);
    for (Index l = 0; l < kTaps; ++l) {
      regressors.col(l).head(l).setZero();
      regressors.col(l).tail(x.size() - l) = x.head(x.size() - l);
    }
    residuals.push_back(experiment.y -
                        regressors * regressors.colPivHouseholderQr().solve(experiment.y));
  }
  return residuals;
}

/// Parameters of a model at a start for Go with a noise model (its polynomials' c and d).
VectorXd parametersOf(const LinearModel& model, const LeastSquaresModel& start) {
  const Polynomials& p = start.polynomials;
  VectorXd parameters = VectorXd::Zero(model.parameterCount());
  const VectorXd theta = model.nominal().fromPolynomials(p);
  parameters.head(theta.size()) = theta;
  if (parameters.size() > theta.size()) {
    const double gain = p.b.sum() / (1 + p.a.sum());
    const bool at_input = model.names().back() == "offset_u";
    parameters[theta.size()] =
        at_input ? (std::abs(gain) > 1e-9 ? start.offset / gain : 0.0) : start.offset;
  }
  return parameters;
}

void addStart(const LinearModel& model, LeastSquaresModel go, const VectorXd& c, const VectorXd& d,
              std::vector<VectorXd>* starts) {
  go.polynomials.c = c;
  go.polynomials.d = d;
  const VectorXd start = parametersOf(model, go);
  if (model.admissible(start)) starts->push_back(start);
}

/// Starts of `go` with noise models fitted to its residuals, and with fixed guesses.
void addStarts(const LinearModel& model, const LeastSquaresModel& go,
               const std::vector<Experiment>& experiments, std::vector<VectorXd>* starts) {
  const Polynomials sizes = sizesOf(model.nominal());
  const int nc = static_cast<int>(sizes.c.size()), nd = static_cast<int>(sizes.d.size());
  VectorXd c, d;
  if (nc + nd > 0) {
    const std::vector<VectorXd> residuals = noiseResiduals(experiments, go);
    if (!residuals.empty()) {
      hannanRissanen(residuals, nc, nd, &c, &d);
      addStart(model, go, c, d, starts);
    }
  }
  for (double first : {0.0, -0.7, 0.5}) {
    c = VectorXd::Zero(nc);
    d = VectorXd::Zero(nd);
    if (nd > 0) d[0] = first;
    if (nd == 0 && nc > 0) c[0] = first;
    addStart(model, go, c, d, starts);
    if (nc + nd == 0) break;
  }
}

/// A mixture of one component, with the variance of relative errors of about 0.2 in each free
/// direction.
Mixture singleComponent(int n) {
  Mixture mixture;
  mixture.weights = {1.0};
  mixture.means = {VectorXd::Zero(n)};
  mixture.covariances = {0.05 * MatrixXd::Identity(n, n)};
  return mixture;
}

/// The first `wanted` of the ranked starts, no more than two of them with the same Go: those differ
/// in the noise model alone, and mostly lead to the same optimum.
std::vector<SingleComponent> ofDifferentPlants(const std::vector<SingleComponent>& ranked,
                                               std::size_t wanted) {
  constexpr int kMostOfOne = 2;
  std::map<double, int> taken;  // by the first parameter, which belongs to Go
  std::vector<SingleComponent> chosen;
  for (const SingleComponent& one : ranked) {
    if (chosen.size() == wanted) break;
    const VectorXd& parameters = one.point.parameters;
    if (parameters.size() == 0 || ++taken[parameters[0]] <= kMostOfOne) chosen.push_back(one);
  }
  return chosen;
}

}  // namespace

std::vector<VectorXd> nominalStarts(const LinearModel& model, const NominalModelOptions& options,
                                    const std::vector<Experiment>& experiments) {
  const bool all = options.structure == Structure::arx || options.structure == Structure::armax ||
                   longestDeadTime(model.nominal()) > 0;
  const std::vector<Experiment> whole = bridged(experiments);
  const std::vector<LeastSquaresModel> models = leastSquaresModels(model, whole);
  std::vector<VectorXd> starts;
  for (std::size_t k = 0; k < models.size(); ++k) {
    if (k != kArx || all || starts.empty()) addStarts(model, models[k], whole, &starts);
  }
  return starts;
}

std::vector<VectorXd> plantStarts(const LinearModel& model, const Polynomials& noise,
                                  const std::vector<Experiment>& experiments) {
  std::vector<VectorXd> starts;
  for (const LeastSquaresModel& go : leastSquaresModels(model, experiments))
    addStart(model, go, noise.c, noise.d, &starts);
  return starts;
}

std::vector<VectorXd> noiseStarts(const LinearModel& model, const Polynomials& plant, double offset,
                                  const std::vector<Experiment>& experiments) {
  LeastSquaresModel go;
  go.polynomials = plant;
  go.offset = offset;
  std::vector<VectorXd> starts;
  addStarts(model, go, experiments, &starts);
  return starts;
}

std::vector<SingleComponent> rankedSingleComponents(const Likelihood& likelihood,
                                                    const std::vector<VectorXd>& starts,
                                                    std::size_t wanted,
                                                    OptimisationOptions options) {
  constexpr int kRankingSteps = 20, kFirstTurns = 1;
  std::vector<SingleComponent> ranked;
  for (const VectorXd& start : starts) {  // each takes one sweep
    ModelParameters point{start, singleComponent(likelihood.model().regressors()), 1.0};
    const Statistics statistics = likelihood.statistics(start, false);
    const Index n = statistics.regressors();
    double sum = 0;
    for (int r = 0; r < statistics.experiments(); ++r) sum += statistics.gram(r)(n, n);
    point.noise_variance = std::max(sum / statistics.samples().sum(), 1e-300);
    options.floor = covarianceFloor(point.mixture);
    const double reached = fitMixture(likelihood, statistics, options, kRankingSteps, 1e-2, &point);
    if (std::isfinite(reached)) ranked.push_back({point, reached});
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const SingleComponent& left, const SingleComponent& right) {
                     return left.log_likelihood > right.log_likelihood;
                   });
  return climbTogether(likelihood, ofDifferentPlants(ranked, wanted), options, kFirstTurns);
}

std::vector<SingleComponent> singleComponentOptima(const Likelihood& likelihood,
                                                   const std::vector<VectorXd>& starts,
                                                   const OptimisationOptions& options) {
  constexpr std::size_t kFinalists = 6;
  constexpr int kTurns = 7;
  return climbTogether(likelihood, rankedSingleComponents(likelihood, starts, kFinalists, options),
                       options, kTurns);
}

std::optional<ModelParameters> bestSingleComponent(const Likelihood& likelihood,
                                                   const std::vector<VectorXd>& starts,
                                                   const OptimisationOptions& options) {
  const std::vector<SingleComponent> optima = singleComponentOptima(likelihood, starts, options);
  if (optima.empty()) return {};
  return optima.front().point;
}

}  // namespace uncertainty_identification
