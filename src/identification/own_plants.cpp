#include "identification/own_plants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "identification/mean_plant.h"
#include "identification/steps.h"
#include "math/constants.h"
#include "math/polynomial.h"
#include "math/symmetric_eigen.h"
#include "model/continuous_poles.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Names = std::vector<std::string>;

/// A single experiment as the data of a problem of its own.
CheckedData single(const Experiment& experiment) {
  CheckedData one;
  one.experiments = {experiment};
  one.blocks = makeBlocks(one.experiments);
  return one;
}

/// The problem of a single experiment, without an error model.
Problem problemOf(const CheckedData& one, Configuration configuration) {
  ErrorModelOptions& errors = configuration.error_model;
  errors.basis = BasisKind::fir;
  errors.constraint = Constraint::free;
  errors.taps = 0;
  errors.components = 1;
  return {one, {}, nullptr, std::move(configuration), {}, {}};
}

/// At most so many of the experiments whose input moves, with their numbers among all.
std::vector<CheckedData> singles(const CheckedData& data, std::size_t most,
                                 std::vector<Index>* numbers = nullptr) {
  std::vector<const Experiment*> moved;
  for (const Experiment& experiment : data.experiments)
    if (experiment.u.size() > 0 && experiment.u.maxCoeff() > experiment.u.minCoeff())
      moved.push_back(&experiment);
  std::vector<CheckedData> some;
  const std::size_t count = std::min(most, moved.size());
  some.reserve(count);  // blocks point to their experiments, which must stay where they are
  for (std::size_t k = 0; k < count; ++k) {
    const Experiment* each = moved[k * moved.size() / count];
    some.push_back(single(*each));
    if (numbers != nullptr) numbers->push_back(each - data.experiments.data());
  }
  return some;
}

/// Whether all poles of a sampled plant have a continuous counterpart.
bool hasModes(const VectorXd& a) {
  constexpr double kFastest = 0.02;
  const Eigen::VectorXcd all = roots(a);
  return std::all_of(all.data(), all.data() + all.size(), [](const std::complex<double>& root) {
    return std::abs(root.imag()) > 1e-9 || root.real() > kFastest;
  });
}

/// The plants of some experiments, all of the order with which these together have the least BIC.
std::vector<StartingPoint> plantsOfLeastBic(const Problem& problem, Journal* journal) {
  constexpr int kInVain = 2, kSamplesEach = 40;
  constexpr std::size_t kEnough = 6;  // experiments
  const std::vector<CheckedData> data = singles(problem.data, kEnough);
  int largest = problem.configuration.nominal_model.max_order;
  for (const CheckedData& one : data)
    largest = std::min(largest, one.experiments.front().samples() / kSamplesEach);
  std::vector<StartingPoint> best;
  double highest = -std::numeric_limits<double>::infinity();
  int best_order = 0;
  for (int order = 1; order <= std::min(largest, best_order + kInVain); ++order) {
    std::vector<StartingPoint> plants;
    double score = 0;
    for (const CheckedData& one : data) {
      if (journal->progress.searchEnds()) return best;
      const Problem own = problemOf(one, problem.configuration);
      const auto fit = fitOfOrder(own, order, journal);
      if (!fit) continue;
      plants.push_back(fit->start());
      score += scoreOf(own, *fit);
    }
    const auto modal = std::count_if(plants.begin(), plants.end(), [&](const auto& plant) {
      return hasModes(plant.polynomials.a);
    });
    if (plants.size() < data.size() || 2 * modal < static_cast<long>(plants.size())) continue;
    if (!(score > highest)) continue;
    highest = score;
    best = std::move(plants);
    best_order = order;
  }
  return best;
}

/// The modal structure of a sampled plant; none where it has none.
std::optional<NominalModelOptions> modalStructure(NominalModelOptions options,
                                                  const Polynomials& plant, double sample_time) {
  if (!hasModes(plant.a)) return {};
  const ContinuousPoles poles = continuousPoles(plant.a, sample_time);
  options.structure = Structure::modal;
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

/// Coordinates with the phases within half a turn of the first plant's.
MatrixXd withoutTurns(MatrixXd coordinates, const Names& names) {
  for (Index j = 0; j < coordinates.rows(); ++j) {
    if (names[static_cast<std::size_t>(j)].rfind("phase", 0) != 0) continue;
    for (Index r = 1; r < coordinates.cols(); ++r)
      coordinates(j, r) -=
          2 * kPi * std::round((coordinates(j, r) - coordinates(j, 0)) / (2 * kPi));
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
  return commonStructure(problem, plantsOfLeastBic(problem, journal));
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
