#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "identification/mean_plant.h"
#include "identification/own_plants.h"
#include "math/symmetric_eigen.h"

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
  MatrixXd all;      ///< a basis, the directions of the largest variation first
  Index varied;      ///< number of those that vary by more than the plants' errors of estimation
  MatrixXd factors;  ///< less 1, of the experiments: 0 for those whose own plant is not known
};

/// The principal axes of the plants about their medians, in units of their errors of estimation.
Directions directionsOf(const OwnPlants& own, int experiments) {
  constexpr double kMost = 3;   // median magnitudes, beyond which a deviation is cut
  constexpr double kClear = 2;  // variances of the errors
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
        unit * axes.eigenvectors().col(at) * std::sqrt(std::max(beyond, kClear));
  }
  const MatrixXd of_own = directions.all.colPivHouseholderQr().solve(deviation);
  directions.factors = MatrixXd::Zero(n, experiments);
  for (Index r = 0; r < of_own.cols(); ++r)
    directions.factors.col(own.experiments[static_cast<std::size_t>(r)]) = of_own.col(r);
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
  const Index n = directions.center.size(), of_noise = own.noise.size() - 1,
              offsets = configuration.estimation.offsets == Offsets::estimate ? 1 : 0;
  VectorXd parameters(n + of_noise + offsets);
  parameters << VectorXd::Ones(n), own.noise.head(of_noise), VectorXd::Constant(offsets, offset);
  return {structure,
          {parameters,
           {{1.0}, {VectorXd::Zero(count)}, {MatrixXd::Identity(count, count)}},
           own.noise[of_noise]}};
}

/// The best of the models that vary along more and more directions. BIC counts the directions
/// among the parameters of the distribution, as the plants show them.
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
    fit->mixture += static_cast<int>(count * (2 * directions.center.size() - count - 1) / 2);
    if (best && scoreOf(problem, *fit) <= scoreOf(problem, *best)) continue;
    best = std::move(fit);
    best_count = count;
  }
  return best;
}

}  // namespace

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
