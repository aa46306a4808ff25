#include "identification/odd_experiments.h"

#include <algorithm>
#include <cmath>

#include "data/text.h"
#include "estimation/excerpt.h"
#include "estimation/simulation_fit.h"
#include "identification/mean_plant.h"
#include "math/median.h"
#include "math/polynomial.h"
#include "model/fixed_plant.h"

namespace uncertainty_identification {
namespace {

/// The factor by which the output follows a simulation, and the share of its variance that does.
struct Multiple {
  double factor = 1, share = 0;
};

/// `error` is output less simulation, 0 where the output was not measured.
Multiple multipleOf(const Experiment& experiment, const Eigen::VectorXd& error) {
  Eigen::ArrayXd measured(experiment.samples());
  for (int k = 0; k < experiment.samples(); ++k) measured[k] = experiment.isValid(k) ? 1 : 0;
  const double count = std::max(measured.sum(), 1.0);
  const auto deviations = [&](const Eigen::ArrayXd& signal) -> Eigen::ArrayXd {
    return measured * (signal - (measured * signal).sum() / count);
  };
  const Eigen::ArrayXd y = measured.select(experiment.y.array(), 0.0);
  const Eigen::ArrayXd output = deviations(y), simulated = deviations(y - error.array());
  const double product = (output * simulated).sum();
  const double power = std::max(simulated.square().sum(), 1e-300);
  return {product / power, product * product / (power * std::max(output.square().sum(), 1e-300))};
}

std::string rangeOf(const std::vector<double>& values) {
  const auto range = std::minmax_element(values.begin(), values.end());
  const std::string least = rounded(*range.first);
  return (values.size() == 1 ? least : least + " to " + rounded(*range.second)) + " times";
}

std::string inWords(const std::string& names, const std::vector<double>& odd,
                    const std::vector<double>& others) {
  return names + ": the output is " + rangeOf(odd) +
         " what the mean plant simulates, and in all other experiments " + rangeOf(others) +
         ": is it another range or sign of the sensor, another unit, or another machine? It "
         "widens all bounds; leave it out if it does not belong to the others";
}

}  // namespace

std::string oddExperiments(const LinearModel& model, const ModelParameters& point, double offset,
                           EstimationOptions options, const std::vector<Experiment>& experiments) {
  constexpr std::size_t kFewest = 4;
  constexpr double kFar = 8, kMaterial = 0.25, kNormal = 1.4826;  // deviations; of the factor
  constexpr double kFollows = 0.5;                                // of the variance
  constexpr double kTimeConstants = 3;  // in the longest experiment, at least
  if (experiments.size() < kFewest) return "";
  options.initial_state = InitialState::estimate;
  const Polynomials plant = meanPlant(model, point);
  // What a slow plant does by itself may look like an answer to the input.
  if (!isStable(plant.a, std::exp(-kTimeConstants / longestOf(experiments)))) return "";
  const std::vector<Eigen::VectorXd> errors =
      simulationErrors(*fixPlant(plant, 0, 0), Eigen::VectorXd(0), offset, options, experiments);
  std::vector<double> factors, departures;
  std::vector<Multiple> multiples;
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    multiples.push_back(multipleOf(experiments[r], errors[r]));
    factors.push_back(multiples.back().factor);
    if (!std::isfinite(factors.back())) return "";
  }
  const double median = medianOf(factors);
  for (const double factor : factors) departures.push_back(std::abs(factor - median));
  const double least =
      std::max(kFar * kNormal * medianOf(departures), kMaterial * std::abs(median));
  std::string names;
  std::vector<double> odd, others;
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    if (!(departures[r] > least)) {
      others.push_back(factors[r]);
      continue;
    }
    if (multiples[r].share < kFollows) return "";  // it does not follow the simulation at all
    names += (names.empty() ? "" : ", ") + named(experiments[r].id);
    odd.push_back(factors[r]);
  }
  const std::size_t most = std::max<std::size_t>(1, experiments.size() / 10);
  if (odd.empty() || odd.size() > most) return "";
  return inWords(names, odd, others);
}

}  // namespace uncertainty_identification
