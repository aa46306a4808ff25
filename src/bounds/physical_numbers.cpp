#include "uncertainty_identification/bounds/physical_numbers.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>

#include "bounds/physical_sentence.h"
#include "math/constants.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Numbers = std::vector<PhysicalNumber>;

constexpr double kHalfWidth95 = 1.959964;  // standard deviations of a two-sided 95 % interval
constexpr double kVanished = 1e-3;         // smaller |z| of a pole: gone after a sample

/// Poles in continuous time.
struct PhysicalPoles {
  std::vector<double> time_constants;       ///< [s] descending
  std::vector<std::complex<double>> pairs;  ///< [rad/s] positive imaginary part, slowest first
  std::vector<double> alternating;          ///< z of the real poles below 0
  int integrators = 0;
  double remainder = 1;  ///< A at z = 1 without its integrators
};

PhysicalPoles physicalPoles(const VectorXd& a, double sample_time, double longest) {
  PhysicalPoles poles;
  std::complex<double> remainder = 1;
  for (const std::complex<double>& root : listOfRoots(a)) {
    const std::complex<double> s = std::log(root) / sample_time;
    const bool real = std::abs(root.imag()) < 1e-9;
    if (real && root.real() > 0 && -s.real() * longest < 1) {
      ++poles.integrators;
      continue;
    }
    remainder *= 1.0 - root;
    if (std::abs(root) < kVanished) continue;
    if (real && root.real() < 0) poles.alternating.push_back(root.real());
    if (real && root.real() > 0) poles.time_constants.push_back(-1 / s.real());
    if (!real && root.imag() > 0) poles.pairs.push_back(s);
  }
  poles.remainder = remainder.real();
  std::sort(poles.time_constants.rbegin(), poles.time_constants.rend());
  std::sort(poles.alternating.begin(), poles.alternating.end());
  std::sort(poles.pairs.begin(), poles.pairs.end(),
            [](auto one, auto other) { return std::abs(one) < std::abs(other); });
  return poles;
}

/// The lowest angle [rad/sample] where |B/A| has fallen by 3 dB from its value at 0; NaN if there
/// is none up to pi.
double bandwidthAngle(const VectorXd& b, const VectorXd& a, double lowest) {
  constexpr int kPoints = 200, kBisections = 40;
  const VectorXd denominator = withLeadingOne(a);
  const auto size = [&](double angle) {
    const std::complex<double> shift = std::polar(1.0, -angle);
    return std::abs(valueAt(b, shift) / valueAt(denominator, shift));
  };
  const double limit = size(0) / std::sqrt(2.0);
  double inside = 0;
  for (int k = 0; k <= kPoints; ++k) {
    double outside = lowest * std::pow(kPi / lowest, static_cast<double>(k) / kPoints);
    if (size(outside) >= limit) {
      inside = outside;
      continue;
    }
    for (int i = 0; i < kBisections; ++i) {
      const double middle = (inside + outside) / 2;
      (size(middle) >= limit ? inside : outside) = middle;
    }
    return outside;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::string numbered(const char* name, std::size_t k, std::size_t count) {
  return count > 1 ? name + ("_" + std::to_string(k + 1)) : name;
}

void addPoles(const PhysicalPoles& poles, Numbers* numbers) {
  const std::size_t reals = poles.time_constants.size(), pairs = poles.pairs.size();
  for (std::size_t k = 0; k < reals; ++k)
    numbers->push_back({numbered("time_constant", k, reals), "s", poles.time_constants[k]});
  for (std::size_t k = 0; k < pairs; ++k) {
    const double frequency = std::abs(poles.pairs[k]);
    numbers->push_back({numbered("natural_frequency", k, pairs), "rad/s", frequency});
    numbers->push_back({numbered("damping", k, pairs), "", -poles.pairs[k].real() / frequency});
  }
  const std::size_t alternating = poles.alternating.size();
  for (std::size_t k = 0; k < alternating; ++k)
    numbers->push_back({numbered("alternating_pole", k, alternating), "", poles.alternating[k]});
}

/// The numbers of B/A, all but the dead time. `longest` [s]: slower poles integrate.
Numbers numbersOf(const VectorXd& b, const VectorXd& a, double sample_time, double longest) {
  const PhysicalPoles poles = physicalPoles(a, sample_time, longest);
  Numbers numbers;
  const double gain = b.sum() / poles.remainder;
  if (poles.integrators == 0) numbers.push_back({"gain", "", gain});
  if (poles.integrators == 1) numbers.push_back({"velocity_gain", "1/s", gain / sample_time});
  if (poles.integrators == 2)
    numbers.push_back({"acceleration_gain", "1/s^2", gain / (sample_time * sample_time)});
  addPoles(poles, &numbers);
  if (poles.integrators > 0) return numbers;
  double lowest = 0.1;
  for (double constant : poles.time_constants)
    lowest = std::min(lowest, 0.1 * sample_time / constant);
  for (const auto& pole : poles.pairs)
    lowest = std::min(lowest, 0.1 * sample_time * std::abs(pole));
  const double angle = bandwidthAngle(b, a, lowest);
  if (std::isfinite(angle)) numbers.push_back({"bandwidth", "rad/s", angle / sample_time});
  return numbers;
}

/// The dead time [s] beyond the one sample of the hold.
PhysicalNumber deadTime(const Estimate& estimate) {
  const NominalModelEstimate& go = estimate.nominal_model;
  PhysicalNumber number{"dead_time", "s", std::max(go.delay - 1, 0) * go.sample_time};
  const auto& fixed = estimate.configuration.nominal_model.fixed;
  if (go.structure == "continuous" && fixed.count("dead_time") > 0)
    number.value += fixed.at("dead_time");
  for (const ParameterEstimate& parameter : go.parameters) {
    if (parameter.name != "dead_time") continue;
    number.value += parameter.value;
    if (!std::isfinite(parameter.standard_error)) continue;
    number.lower = std::max(0.0, number.value - kHalfWidth95 * parameter.standard_error);
    number.upper = number.value + kHalfWidth95 * parameter.standard_error;
  }
  return number;
}

/// The values that a number has among the draws, ascending; empty if too many draws lack it.
std::vector<double> valuesOf(const std::string& name, const std::vector<Numbers>& draws) {
  constexpr double kShare = 0.95;
  std::vector<double> values;
  for (const Numbers& draw : draws) {
    for (const PhysicalNumber& number : draw) {
      if (number.name == name && std::isfinite(number.value)) values.push_back(number.value);
    }
  }
  const bool enough =
      static_cast<double>(values.size()) >= kShare * static_cast<double>(draws.size());
  if (!enough) values.clear();
  std::sort(values.begin(), values.end());
  return values;
}

void addInterval(const std::vector<Numbers>& draws, PhysicalNumber* number) {
  const std::vector<double> values = valuesOf(number->name, draws);
  if (values.empty()) return;
  const auto quantile = [&](double share) {
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  };
  number->lower = quantile(0.025);
  number->upper = quantile(0.975);
}

void addSpread(const std::vector<Numbers>& draws, PhysicalNumber* number) {
  const std::vector<double> values = valuesOf(number->name, draws);
  if (values.empty()) return;
  const Eigen::Map<const VectorXd> all(values.data(), static_cast<Index>(values.size()));
  const double deviation = std::sqrt((all.array() - all.mean()).square().mean());
  const bool rounding = deviation < 1e-9 * std::abs(number->value);
  number->spread = rounding ? 0 : deviation;
}

/// Whether the error model says how this number differs between experiments. Filters in series with
/// Go leave its poles as they are, and so do the derivatives of basis sensitivity.
bool hasSpread(const PhysicalNumber& number, BasisKind basis) {
  const bool of_response =
      number.name == "bandwidth" || number.name.find("gain") != std::string::npos;
  return of_response || basis == BasisKind::parameter_spread;
}

/// The standard deviation of a parameter that varies by relative deviations xi.
std::optional<double> spreadOf(const std::string& parameter, const Estimate& estimate) {
  const auto& names = estimate.error_model.options.parameters;
  const auto found = std::find(names.begin(), names.end(), parameter);
  if (estimate.error_model.options.basis != BasisKind::parameter_spread || found == names.end())
    return {};
  const auto k = static_cast<Index>(found - names.begin());
  for (const ParameterEstimate& one : estimate.nominal_model.parameters) {
    if (one.name == parameter)
      return one.value * std::sqrt(estimate.error_model.mixture.covariance()(k, k));
  }
  return {};
}

using Compute = std::function<Numbers(const VectorXd& b, const VectorXd& a)>;

std::vector<Numbers> drawnNumbers(const PlantDistribution& plants, Uncertainty uncertainty,
                                  std::uint64_t seed, const Compute& compute) {
  constexpr int kDraws = 1000;
  const PlantSamples drawn = plants.draw(kDraws, uncertainty, seed);
  TransferFunctions all{drawn.b, Eigen::MatrixXd::Ones(drawn.count(), drawn.a.cols() + 1)};
  all.den.rightCols(drawn.a.cols()) = drawn.a;
  if (uncertainty == Uncertainty::mixture && drawn.eta.cols() > 0) all = transferFunctions(drawn);
  std::vector<Numbers> numbers;
  for (Index i = 0; i < drawn.count(); ++i) {
    const VectorXd denominator = all.den.row(i).transpose();
    numbers.push_back(
        compute(all.num.row(i).transpose(), denominator.tail(denominator.size() - 1)));
  }
  return numbers;
}

void addUncertainty(const Estimate& estimate, const PlantDistribution& plants,
                    const Compute& compute, Numbers* numbers) {
  const std::uint64_t seed = estimate.configuration.estimation.seed;
  if (plants.hasEstimationErrors()) {
    const auto draws = drawnNumbers(plants, Uncertainty::estimate, seed, compute);
    for (PhysicalNumber& number : *numbers) addInterval(draws, &number);
  }
  if (estimate.error_model.mixture.dimension() == 0) return;
  const auto draws = drawnNumbers(plants, Uncertainty::mixture, seed, compute);
  for (PhysicalNumber& number : *numbers) {
    if (hasSpread(number, estimate.error_model.options.basis)) addSpread(draws, &number);
  }
}

/// [s] Time constants beyond it cannot be told from an integrator.
double longestTimeConstant(const Estimate& estimate) {
  constexpr double kRecords = 10;
  int longest = 0;
  for (const ExperimentEstimate& experiment : estimate.experiments)
    longest = std::max(longest, experiment.samples);
  return longest > 0 ? kRecords * longest * estimate.nominal_model.sample_time
                     : std::numeric_limits<double>::max();
}

}  // namespace

PhysicalNumbers physicalNumbers(const Estimate& estimate, const PlantDistribution* plants) {
  const NominalModelEstimate& go = estimate.nominal_model;
  const double longest = longestTimeConstant(estimate);
  const Compute compute = [&](const VectorXd& b, const VectorXd& a) {
    return numbersOf(b, a, go.sample_time, longest);
  };
  PhysicalNumbers physical{"", compute(go.b, go.a)};
  if (plants != nullptr) addUncertainty(estimate, *plants, compute, &physical.numbers);
  PhysicalNumber dead_time = deadTime(estimate);
  if (plants != nullptr) dead_time.spread = spreadOf("dead_time", estimate);
  const bool has_bandwidth =
      !physical.numbers.empty() && physical.numbers.back().name == "bandwidth";
  physical.numbers.insert(physical.numbers.end() - (has_bandwidth ? 1 : 0), dead_time);
  physical.sentence = physicalSentence(physical.numbers);
  return physical;
}

}  // namespace uncertainty_identification
