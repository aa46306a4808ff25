#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

#include "identification/mean_plant.h"
#include "identification/own_plants.h"
#include "identification/steps.h"
#include "math/symmetric_eigen.h"
#include "model/modal.h"

/// Plants whose modes differ from experiment to experiment. One plant simulates all of them poorly,
/// so that neither orders nor a start can be found from all experiments together. Each experiment
/// alone shows them: the orders are those with which single experiments have the least BIC, and the
/// start is the distribution of their own plants, as in two-stage estimation of mixed effects
/// (Davidian and Giltinan 1995, chapter 5).
namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// How plants differ: a centre, and directions that scale with the standard deviations along them.
struct Directions {
  VectorXd center;
  MatrixXd all;  ///< a basis, the directions of the largest variation first, kDeviations long
  Index varied;  ///< number of those in which plants may differ beyond their errors of estimation
  MatrixXd factors;  ///< less 1, of the experiments: 0 for those whose own plant is not known
};

/// A factor of 1 is so many standard deviations away from 0: factors vary relative to their values,
/// which must not come near 0 when the centre moves.
constexpr double kDeviations = 10;

/// The factors, less 1, of the plants with these deviations from the centre; 0 for other
/// experiments.
MatrixXd factorsOf(const MatrixXd& directions, const MatrixXd& deviation, const OwnPlants& own,
                   int experiments) {
  const MatrixXd of_own = directions.colPivHouseholderQr().solve(deviation);
  MatrixXd factors = MatrixXd::Zero(directions.cols(), experiments);
  for (Index r = 0; r < of_own.cols(); ++r)
    factors.col(own.experiments[static_cast<std::size_t>(r)]) = of_own.col(r);
  return factors;
}

/// Where the optimisation of a model starts in which `count` of the factors vary.
ModelParameters startAlong(Index factors, Index count, const OwnPlants& own, double offset,
                           const Configuration& configuration) {
  const Index of_noise = own.noise.size() - 1,
              offsets = configuration.estimation.offsets == Offsets::estimate ? 1 : 0;
  VectorXd parameters(factors + of_noise + offsets);
  parameters << VectorXd::Ones(factors), own.noise.head(of_noise),
      VectorXd::Constant(offsets, offset);
  const MatrixXd covariance = MatrixXd::Identity(count, count) / (kDeviations * kDeviations);
  return {parameters, {{1.0}, {VectorXd::Zero(count)}, {covariance}}, own.noise[of_noise]};
}

/// The principal axes of the plants about their medians, in units of their errors of estimation.
Directions directionsOf(const OwnPlants& own, int experiments) {
  constexpr double kMost = 3;     // median magnitudes, beyond which a deviation is cut
  constexpr double kClear = 0.7;  // variances of the errors; BIC decides which of them count
  Directions directions;
  directions.center = medians(own.coordinates);
  MatrixXd deviation = own.coordinates.colwise() - directions.center;
  const VectorXd usual = medians(deviation.cwiseAbs());
  for (Index j = 0; j < usual.size(); ++j)
    deviation.row(j) =
        deviation.row(j).cwiseMax(-kMost * usual[j]).cwiseMin(kMost * usual[j]).eval();
  const MatrixXd of_plants =
      deviation * deviation.transpose() / static_cast<double>(deviation.cols() - 1);
  const SymmetricEigen errors(own.covariance);
  const double least = 1e-12 * errors.eigenvalues().maxCoeff();
  const VectorXd error = errors.eigenvalues().cwiseMax(least).cwiseSqrt();
  const MatrixXd unit = errors.eigenvectors() * error.asDiagonal(),
                 inverse = error.cwiseInverse().asDiagonal() * errors.eigenvectors().transpose();
  const SymmetricEigen axes(inverse * of_plants * inverse.transpose());
  const Index n = usual.size();
  directions.all.resize(n, n);
  directions.varied = 0;
  for (Index k = 0; k < n; ++k) {
    const Index at = n - 1 - k;  // eigenvalues ascend
    const double beyond = axes.eigenvalues()[at] - 1;
    if (beyond > kClear) ++directions.varied;
    directions.all.col(k) =
        kDeviations * unit * axes.eigenvectors().col(at) * std::sqrt(std::max(beyond, kClear));
  }
  directions.factors = factorsOf(directions.all, deviation, own, experiments);
  return directions;
}

/// The model in which the first `count` directions vary, and where its optimisation starts.
std::pair<ErrorStructure, ModelParameters> along(const Directions& directions, Index count,
                                                 const OwnPlants& own, double offset,
                                                 const Configuration& configuration) {
  ErrorStructure structure{
      "modes that differ in " + std::to_string(count) + (count == 1 ? " way" : " ways"),
      configuration};
  structure.configuration.nominal_model.center = directions.center;
  structure.configuration.nominal_model.directions = directions.all;
  ErrorModelOptions& errors = structure.configuration.error_model;
  errors.basis = BasisKind::parameter_spread;
  errors.constraint = Constraint::zero_mean;
  errors.taps = static_cast<int>(count);
  for (Index k = 1; k <= count; ++k) errors.parameters.push_back("factor" + std::to_string(k));
  return {structure, startAlong(directions.center.size(), count, own, offset, configuration)};
}

/// The best of the models that vary along more and more directions.
std::optional<StructureFit> fitDirections(const Problem& problem, const OwnPlants& own,
                                          double offset, Journal* journal) {
  constexpr Index kMost = 6, kInVain = 2;
  const Directions directions = directionsOf(own, problem.data.count());
  std::optional<StructureFit> best;
  Index best_count = 0;
  for (Index count = 1; count <= std::min(kMost, directions.varied); ++count) {
    const bool are_many = problem.data.count() > count * (count + 1) / 2;
    if (!are_many || count > best_count + kInVain || journal->progress.searchEnds()) break;
    const auto next = along(directions, count, own, offset, problem.configuration);
    auto fit = fitStructureFrom(problem, next.first, next.second, directions.factors.topRows(count),
                                journal);
    if (!fit || !plantsExist(*fit)) continue;
    if (best && scoreOf(problem, *fit) <= scoreOf(problem, *best)) continue;
    best = std::move(fit);
    best_count = count;
  }
  return best;
}

/// The plant in the middle of the stated directions.
StartingPoint centreOf(const Problem& problem) {
  const auto nominal =
      makeNominalModel(problem.configuration.nominal_model, problem.data.sampleTime());
  VectorXd theta = VectorXd::Zero(nominal->parameterCount());
  theta.head(problem.configuration.nominal_model.center.size()).setOnes();
  return {nominal->polynomials(theta)};
}

}  // namespace

std::optional<StructureFit> fitStatedModes(const Problem& problem, Journal* journal) {
  const ErrorModelOptions& errors = problem.configuration.error_model;
  if (!variesAlongDirections(problem.configuration) || problem.plant ||
      hasGivenParameters(problem) || givenMixture(problem).components() > 0)
    return {};
  const StartingPoint centre = centreOf(problem);
  Problem of_modes = problem;
  NominalModelOptions& nominal = of_modes.configuration.nominal_model;
  const Directions stated{
      std::exchange(nominal.center, {}), std::exchange(nominal.directions, {}), 0, {}};
  const auto own = ownPlants(of_modes, centre, journal);
  if (!own) return {};
  const MatrixXd factors =
      factorsOf(stated.all, own->coordinates.colwise() - stated.center, *own, problem.data.count());
  const std::vector<std::string> names =
      makeNominalModel(problem.configuration.nominal_model, problem.data.sampleTime())->names();
  const auto count = static_cast<Index>(errors.parameters.size());
  MatrixXd varied(count, factors.cols());
  for (Index k = 0; k < count; ++k) {
    const std::string& name = errors.parameters[static_cast<std::size_t>(k)];
    varied.row(k) = factors.row(std::find(names.begin(), names.end(), name) - names.begin());
  }
  const ErrorStructure structure{"stated directions", problem.configuration};
  return fitStructureFrom(problem, structure,
                          startAlong(stated.center.size(), count, *own, 0, problem.configuration),
                          varied, journal);
}

std::optional<StructureFit> fitModes(Problem problem, Journal* journal) {
  constexpr int kFewest = 3;  // experiments that show how modes vary
  if (problem.data.count() < kFewest || problem.data.single_steps) return {};
  const auto start = modalStart(problem, journal);
  if (!start) return {};
  problem.configuration.nominal_model = start->structure;
  const auto own = ownPlants(problem, start->plant, journal);
  if (!own) return {};
  return fitDirections(problem, *own, start->plant.offset, journal);
}

}  // namespace uncertainty_identification
