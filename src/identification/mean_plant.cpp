#include "identification/mean_plant.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "estimation/excerpt.h"
#include "estimation/mean_plant.h"
#include "identification/steps.h"
#include "math/symmetric_eigen.h"
#include "model/fixed_plant.h"
#include "model/sensitivity.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

Polynomials meanPlant(const LinearModel& model, const ModelParameters& point) {
  const Polynomials plant = plantOf(model, point).polynomials;
  const ErrorBasis& basis = model.basis();
  if (basis.kind() != BasisKind::fir || basis.dimension() == 0) return plant;
  return filteredPlant(plant, basis.T(), point.mixture.mean());
}

bool plantsExist(const StructureFit& fit) {
  constexpr double kDeviations = 1.6;  // 5 % of a Gaussian lie beyond on each side
  const ErrorModelOptions& options = fit.structure.configuration.error_model;
  if (options.basis != BasisKind::parameter_spread) return true;
  const NominalModel& nominal = fit.model->nominal();
  const SensitivityTerms terms = sensitivityTerms(nominal, options);
  const Eigen::VectorXd theta = fit.point.parameters.head(nominal.parameterCount());
  const Mixture& mixture = fit.point.mixture;
  for (std::size_t i = 0; i < mixture.means.size(); ++i) {
    const SymmetricEigen eigen(mixture.covariances[i]);
    const Eigen::VectorXd sizes = kDeviations * eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
    for (Eigen::Index axis = 0; axis < sizes.size(); ++axis)
      for (const double side : {-sizes[axis], sizes[axis]}) {
        const Eigen::VectorXd xi = mixture.means[i] + side * eigen.eigenvectors().col(axis);
        Eigen::VectorXd moved = theta;
        for (int k = 0; k < terms.count(); ++k)
          moved[terms.indices[static_cast<std::size_t>(k)].front()] *= 1 + xi[k];
        if (!nominal.admissible(moved)) return false;
      }
  }
  return true;
}

namespace {

/// The plant at error parameters `xi`; none where it does not exist, or the error model has other
/// filters than FIR.
std::optional<Polynomials> ownPlant(const ErrorModelOptions& options, const LinearModel& model,
                                    const ModelParameters& point, const Eigen::VectorXd& xi) {
  if (options.basis == BasisKind::fir)
    return filteredPlant(plantOf(model, point).polynomials, model.basis().T(), xi);
  if (options.basis != BasisKind::parameter_spread) return {};
  const NominalModel& nominal = model.nominal();
  const SensitivityTerms terms = sensitivityTerms(nominal, options);
  Eigen::VectorXd theta = point.parameters.head(nominal.parameterCount());
  for (int k = 0; k < terms.count(); ++k)
    theta[terms.indices[static_cast<std::size_t>(k)].front()] *= 1 + xi[k];
  if (!nominal.admissible(theta)) return {};
  return nominal.polynomials(theta);
}

/// The plant without coefficients of B that are zero at either end, as those beside a dead time
/// are: a model of its size has no use for them.
Polynomials trimmed(Polynomials plant) {
  const double least = 1e-9 * plant.b.cwiseAbs().maxCoeff();
  Eigen::Index first = 0, last = plant.b.size() - 1;
  while (first < last && std::abs(plant.b[first]) <= least) ++first;
  while (last > first && std::abs(plant.b[last]) <= least) --last;
  plant.delay += static_cast<int>(first);
  plant.b = plant.b.segment(first, last - first + 1).eval();
  return plant;
}

/// A plant of the same size, fitted to nothing but its simulation; none where no start is found.
std::optional<FittedPlant> aloneOfSameSize(Problem problem, const Polynomials& plant,
                                           Journal* journal) {
  const Polynomials size = trimmed(plant);
  NominalModelOptions& nominal = problem.configuration.nominal_model;
  nominal.nb = static_cast<int>(size.b.size());
  nominal.na = static_cast<int>(size.a.size());
  nominal.delay = size.delay;
  nominal.fit = PlantFit::simulation;
  try {
    return fitPlant(problem, journal);
  } catch (const DataError&) {
    return std::nullopt;
  }
}

}  // namespace

bool simulatesAsWellAsAlone(const Problem& whole, const LinearModel& model,
                            const ModelParameters& point, const FittedPlant& chosen_alone,
                            Journal* journal) {
  constexpr double kMuch = 10;  // [% of fit] beyond what free responses of slow poles are worth
  CheckedData data;
  data.experiments = fewerSamples(whole.data.experiments, kEnoughSamples);
  data.blocks = makeBlocks(data.experiments);
  const Problem problem{data, {}, nullptr, whole.configuration, {}, {}};
  const FittedPlant joint = plantOf(model, point);
  const SimulationFit jointly = fitOf(problem, meanPlant(model, point), joint.offset);
  const SimulationFit chosen = fitOf(problem, chosen_alone.polynomials, chosen_alone.offset);
  if (jointly.pooled >= chosen.pooled) return true;
  if (!(jointly.pooled > chosen.pooled - kMuch)) return false;
  const std::optional<FittedPlant> plant = aloneOfSameSize(problem, joint.polynomials, journal);
  return !plant || !simulatesWorse(jointly, fitOf(problem, plant->polynomials, plant->offset));
}

namespace {

/// Whether the errors of most experiments are smaller than a share of those of another simulation:
/// the plant of a single one may be lost.
bool mostErrorsAreSmaller(const SimulationFit& one, const SimulationFit& other, double share) {
  constexpr double kMost = 0.75;  // of the experiments
  std::size_t smaller = 0;
  for (std::size_t r = 0; r < one.percent.size(); ++r)
    smaller += 100 - one.percent[r] < share * (100 - other.percent[r]) ? 1 : 0;
  return static_cast<double>(smaller) >= kMost * static_cast<double>(one.percent.size());
}

}  // namespace

bool areMany(const Problem& problem, const LinearModel& model) {
  const int n = model.regressors();
  return problem.data.count() > n * (n + 1);
}

bool simulatesByOwnPlants(const Problem& problem, const FittedModel& fitted,
                          const FittedPlant& chosen_alone) {
  constexpr double kFarLess = 0.5;     // of the error
  constexpr double kNearlyNone = 0.1;  // of the error
  constexpr double kMuch = 10;         // [% of fit] by which a mean of filters may be worse
  if (problem.configuration.error_model.taps == 0) return false;
  const ModelParameters& point = fitted.optimum.point;
  const Eigen::MatrixXd means =
      latentMoments(
          fitted.likelihood->expect(fitted.likelihood->statistics(point.parameters, false), point))
          .means;
  const double offset = plantOf(*fitted.model, point).offset;
  std::vector<Eigen::VectorXd> errors;
  for (Eigen::Index r = 0; r < means.cols(); ++r) {
    const std::optional<Polynomials> own =
        ownPlant(problem.configuration.error_model, *fitted.model, point, means.col(r));
    if (!own) return false;
    const Experiment& experiment = problem.data.experiments[static_cast<std::size_t>(r)];
    errors.push_back(simulationErrors(*fixPlant(*own, 0, 0), Eigen::VectorXd(0), offset,
                                      problem.configuration.estimation, {experiment})
                         .front());
  }
  const SimulationFit own = fitOfErrors(errors, problem.data.experiments),
                      alone = fitOf(problem, chosen_alone.polynomials, chosen_alone.offset);
  if (problem.configuration.nominal_model.structure == Structure::modal)
    return mostErrorsAreSmaller(own, alone, kFarLess);
  const double of_mean = fitOf(problem, meanPlant(*fitted.model, point), offset).pooled;
  const bool is_spread = problem.configuration.error_model.basis == BasisKind::parameter_spread;
  const double of_alone = 100 - alone.pooled, of_own = 100 - own.pooled;
  const bool hardly_an_error = areMany(problem, *fitted.model) && of_own < kNearlyNone * of_alone;
  return (is_spread || hardly_an_error || of_mean > alone.pooled - kMuch) &&
         of_own < kFarLess * of_alone;
}

SimulationFit meanPlantFit(const LinearModel& model, const ModelParameters& point, double offset,
                           const EstimationOptions& options,
                           const std::vector<Experiment>& experiments) {
  const NominalModel& nominal = model.nominal();
  const Eigen::VectorXd theta = point.parameters.head(nominal.parameterCount());
  const Polynomials go = nominal.polynomials(theta), mean = meanPlant(model, point);
  if (mean.b.size() == go.b.size())
    return simulationFit(nominal, theta, offset, options, experiments);
  return simulationFit(*fixPlant(mean, 0, 0), Eigen::VectorXd(0), offset, options, experiments);
}

SimulationFit fitOf(const Problem& problem, const Polynomials& plant, double offset) {
  return simulationFit(*fixPlant(plant, 0, 0), Eigen::VectorXd(0), offset,
                       problem.configuration.estimation, problem.data.experiments);
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
