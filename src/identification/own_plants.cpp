#include "identification/own_plants.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "identification/mean_plant.h"
#include "identification/single_fits.h"
#include "identification/steps.h"
#include "math/constants.h"
#include "math/symmetric_eigen.h"
#include "model/continuous_poles.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Names = std::vector<std::string>;

/// The modal structure of a sampled plant; none where it has none.
std::optional<NominalModelOptions> modalStructure(NominalModelOptions options,
                                                  const Polynomials& plant, double sample_time) {
  if (!hasModes(plant.a)) return {};
  const ContinuousPoles poles = continuousPoles(plant.a, sample_time);
  options.structure = Structure::modal;
  options.fixed.clear();
  options.zeros = 0;
  options.dead_time = false;
  options.time_constants = static_cast<int>(poles.time_constants.size());
  options.resonances = static_cast<int>(poles.pairs.size());
  options.delay = plant.delay;
  options.feedthrough = plant.delay == 0;
  return options;
}

/// The structure that most of the plants have, with the one of them that simulates all experiments
/// best.
std::optional<ModalStart> commonStructure(const Problem& problem,
                                          const std::vector<StartingPoint>& plants) {
  using Sizes = std::tuple<int, int, int>;
  std::map<Sizes, int> counts;
  std::vector<std::pair<Sizes, ModalStart>> all;
  for (const StartingPoint& plant : plants) {
    const auto modal = modalStructure(problem.configuration.nominal_model, plant.polynomials,
                                      problem.data.sampleTime());
    if (!modal) continue;
    const Sizes sizes{modal->time_constants, modal->resonances, modal->delay};
    ++counts[sizes];
    all.push_back({sizes, {*modal, plant}});
  }
  std::optional<ModalStart> best;
  std::pair<int, double> highest{0, 0};
  for (const auto& [sizes, start] : all) {
    const double fit = fitOf(problem, start.plant.polynomials, start.plant.offset).pooled;
    const std::pair<int, double> worth{counts[sizes], std::isfinite(fit) ? fit : -1e300};
    if (best && worth <= highest) continue;
    highest = worth;
    best = start;
  }
  return best;
}

/// The plant of one experiment: its coordinates, their covariance, and [c; d; noise variance].
struct OwnPlant {
  VectorXd coordinates, noise;
  MatrixXd covariance;
};

std::optional<OwnPlant> ownPlant(const Problem& alone, const StartingPoint& start,
                                 Journal* journal) {
  const auto fit = fitStructure(alone, structureForOrders(alone), {start}, false, journal);
  if (!fit) return {};
  const NominalModelOptions& options = alone.configuration.nominal_model;
  const Index size = fit->model->nominal().parameterCount(), of_noise = options.nc + options.nd,
              own = size - of_noise;
  const Parametrisation parametrisation(*fit->model, Constraint::free, 1, MatrixXd(0, 0));
  const StandardErrors errors =
      standardErrors(*likelihoodOf(alone, *fit->model), parametrisation, fit->point);
  const VectorXd z = fit->model->nominal().toUnbounded(fit->point.parameters.head(size));
  OwnPlant plant{z.head(own), VectorXd(of_noise + 1),
                 errors.coordinate_covariance.topLeftCorner(own, own)};
  plant.noise << fit->point.parameters.segment(own, of_noise), fit->point.noise_variance;
  if (!plant.covariance.allFinite() || !plant.coordinates.allFinite()) return {};
  return plant;
}

/// Of a covariance or information that may be singular by rounding.
MatrixXd inverseOf(const MatrixXd& positive) {
  constexpr double kLeast = 1e-12;
  const SymmetricEigen eigen(positive);
  const VectorXd values =
      eigen.eigenvalues().cwiseMax(kLeast * eigen.eigenvalues().maxCoeff()).cwiseInverse();
  return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

/// Coordinates with the phases within half a turn of their circular mean.
MatrixXd withoutTurns(MatrixXd coordinates, const Names& names) {
  for (Index j = 0; j < coordinates.rows(); ++j) {
    if (names[static_cast<std::size_t>(j)].rfind("phase", 0) != 0) continue;
    const Eigen::ArrayXd phases = coordinates.row(j).transpose().array();
    const double mean = std::atan2(phases.sin().sum(), phases.cos().sum());
    coordinates.row(j).array() -= 2 * kPi * ((phases.transpose() - mean) / (2 * kPi)).round();
  }
  return coordinates;
}

}  // namespace

VectorXd medians(const MatrixXd& values) {
  VectorXd middle(values.rows());
  for (Index j = 0; j < values.rows(); ++j) {
    VectorXd row = values.row(j);
    std::nth_element(row.data(), row.data() + row.size() / 2, row.data() + row.size());
    middle[j] = row[row.size() / 2];
  }
  return middle;
}

std::optional<ModalStart> modalStart(const Problem& problem, Journal* journal) {
  constexpr std::size_t kEnough = 6;  // experiments
  return commonStructure(problem,
                         plantsOfLeastBic(problem, singles(problem.data, kEnough), journal));
}

std::optional<OwnPlants> ownPlants(const Problem& problem, const StartingPoint& start,
                                   Journal* journal) {
  constexpr std::size_t kMost = 40, kFewest = 3;
  std::vector<OwnPlant> all;
  std::vector<Index> numbers, used;
  const std::vector<CheckedData> some = singles(problem.data, kMost, &numbers);
  for (std::size_t k = 0; k < some.size() && !journal->progress.searchEnds(); ++k) {
    auto plant = ownPlant(problemOf(some[k], problem.configuration), start, journal);
    if (!plant) continue;
    all.push_back(std::move(*plant));
    used.push_back(numbers[k]);
  }
  if (all.size() < kFewest) return {};
  const auto count = static_cast<Index>(all.size());
  const Index size = all[0].coordinates.size();
  OwnPlants own{MatrixXd(size, count), used, {}, {}};
  MatrixXd noise(all[0].noise.size(), count), information = MatrixXd::Zero(size, size);
  for (Index r = 0; r < count; ++r) {
    const OwnPlant& plant = all[static_cast<std::size_t>(r)];
    own.coordinates.col(r) = plant.coordinates;
    information += inverseOf(plant.covariance) / static_cast<double>(count);
    noise.col(r) = plant.noise;
  }
  own.covariance = inverseOf(information);
  own.noise = medians(noise);
  const auto nominal =
      makeNominalModel(problem.configuration.nominal_model, problem.data.sampleTime());
  own.coordinates = withoutTurns(std::move(own.coordinates), nominal->names());
  return own;
}

}  // namespace uncertainty_identification
