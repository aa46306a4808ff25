#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "io/truth_yaml.h"
#include "math/polynomial.h"
#include "simulation/simulate.h"
#include "uncertainty_identification/baselines/baseline.h"
#include "uncertainty_identification/bounds/uncertainty_bounds.h"
#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/io/configuration_yaml.h"
#include "uncertainty_identification/model/error_basis.h"

/// Monte Carlo study of the paper's examples: regions of |G| against fresh true systems.
namespace uncertainty_identification::paper {

constexpr double kLevel = 0.95;
constexpr int kFreshSystems = 1000;
constexpr std::uint64_t kFreshSeed = 900001;  // no data set's seed

inline std::string configPath(const std::string& name) {
  return std::string(PROJECT_FOLDER) + "/config/" + name + ".yaml";
}

/// Mean and standard deviation of some numbers.
struct Spread {
  std::vector<double> values;

  double mean() const {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }
  double deviation() const {
    const double centre = mean();
    double sum = 0;
    for (double value : values) sum += (value - centre) * (value - centre);
    return std::sqrt(sum / std::max(1.0, static_cast<double>(values.size()) - 1));
  }
  double errorOfMean() const { return deviation() / std::sqrt(static_cast<double>(values.size())); }
};

/// Numbers held against stated limits; told at the end.
class Checks {
 public:
  /// Without `asked` nothing is told and nothing fails.
  explicit Checks(bool asked) : asked_(asked) {}

  void within(const std::string& what, double value, double low, double high) {
    const bool good = value >= low && value <= high;
    if (!good) ++failed_;
    char line[200];
    std::snprintf(line, sizeof line, "%-6s %-62s %9.4f in [%.4f, %.4f]\n",
                  good ? "passed" : "FAILED", what.c_str(), value, low, high);
    lines_ += line;
  }

  /// Exit status.
  int report() const {
    if (!asked_) return 0;
    std::printf("\n%s%s\n", lines_.c_str(), failed_ == 0 ? "passed" : "FAILED");
    return failed_ == 0 ? 0 : 1;
  }

 private:
  bool asked_;
  int failed_ = 0;
  std::string lines_;
};

/// |G| of the systems that experiments of a truth are made with, from the `first` on: systems x
/// frequencies.
inline Eigen::ArrayXXd trueMagnitudes(const Truth& truth, int count, const Eigen::VectorXd& omega,
                                      int first = 0) {
  Eigen::ArrayXXd magnitudes(count, omega.size());
  for (int r = 0; r < count; ++r) {
    const DrawnSystem system = drawSystem(truth, kFreshSeed, first + r);
    for (Eigen::Index k = 0; k < omega.size(); ++k) {
      const std::complex<double> shift = std::polar(1.0, -omega[k] * truth.sample_time);
      std::complex<double> b = 0, a = 1, power = 1;
      for (Eigen::Index i = 0; i < system.polynomials.b.size(); ++i, power *= shift)
        b += system.polynomials.b[i] * power;
      power = shift;
      for (Eigen::Index i = 0; i < system.polynomials.a.size(); ++i, power *= shift)
        a += system.polynomials.a[i] * power;
      std::complex<double> relative = 1;
      if (system.component) {
        const ErrorBasis basis(truth.error_model.basis);
        relative += (basis.responses(shift).transpose() * (basis.T() * system.xi))(0);
      }
      magnitudes(r, k) = std::abs(b / a * relative);
    }
  }
  return magnitudes;
}

/// How a region of |G| fares with fresh systems.
struct RegionScore {
  Eigen::ArrayXd inside;    ///< share of the systems at each frequency
  double simultaneous = 0;  ///< share inside at all frequencies
  double area = 0;          ///< [dB decades]
};

inline RegionScore score(const Band& band, const Eigen::ArrayXXd& fresh,
                         const Eigen::VectorXd& omega) {
  // limits are kept in single precision, relative to Go
  constexpr double kRounding = 1e-8;
  RegionScore result;
  const Eigen::ArrayXd lower = band.lower.array() * (1 - kRounding),
                       upper = band.upper.array() * (1 + kRounding);
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> in(fresh.rows(), fresh.cols());
  for (Eigen::Index k = 0; k < omega.size(); ++k)
    in.col(k) = fresh.col(k) >= lower[k] && fresh.col(k) <= upper[k];
  result.inside = in.cast<double>().colwise().mean().transpose();
  result.simultaneous = in.rowwise().all().cast<double>().mean();
  const Eigen::ArrayXd height = 20 * (upper / lower.max(1e-12)).log10();
  for (Eigen::Index k = 1; k < omega.size(); ++k)
    result.area += 0.5 * (height[k] + height[k - 1]) * std::log10(omega[k] / omega[k - 1]);
  return result;
}

/// Scores of one method's regions over all data sets.
struct Scores {
  Eigen::ArrayXd inside;  ///< mean share at each frequency
  Spread simultaneous, area;

  void add(const RegionScore& one) {
    const auto before = static_cast<double>(area.values.size());
    if (inside.size() == 0) inside = Eigen::ArrayXd::Zero(one.inside.size());
    inside = (inside * before + one.inside) / (before + 1);
    simultaneous.values.push_back(one.simultaneous);
    area.values.push_back(one.area);
  }
};

/// A method over all data sets: its parameters and its regions.
struct MethodResult {
  std::map<std::string, Spread> parameters;  ///< theta and "noise_variance"
  Scores mixture, total;  ///< regions of the distribution alone, and with the estimate's errors
  Band first;             ///< the region of the first data set
  std::vector<Mixture> mixtures;  ///< of all data sets
  Eigen::VectorXd nominal;        ///< sum of |Go| over the data sets
  int failed = 0;                 ///< estimates that did not converge
};

inline void addParameters(const Estimate& estimate, MethodResult* result) {
  for (const ParameterEstimate& parameter : estimate.nominal_model.parameters)
    result->parameters[parameter.name].values.push_back(parameter.value);
  result->parameters["noise_variance"].values.push_back(estimate.noise_variance.value);
  if (estimate.termination != Termination::converged) ++result->failed;
}

inline void addNominal(const Eigen::VectorXd& magnitude, MethodResult* result) {
  if (result->nominal.size() == 0) result->nominal = Eigen::VectorXd::Zero(magnitude.size());
  result->nominal += magnitude;
}

/// |G| of the only plant.
inline Eigen::VectorXd magnitudesOf(const PlantSamples& plant, const Eigen::VectorXd& omega) {
  const ComplexResponses response = frequencyResponses(plant, omega);
  return (response.real.row(0).array().square() + response.imaginary.row(0).array().square())
      .sqrt()
      .matrix()
      .transpose();
}

/// Stochastic embedding from one data set.
inline void addEmbedding(const Configuration& configuration,
                         const std::vector<Experiment>& experiments, const Eigen::VectorXd& omega,
                         const Eigen::ArrayXXd& fresh, MethodResult* result) {
  const Estimate estimate = Identifier(configuration).identify(experiments);
  addParameters(estimate, result);
  BoundsOptions options;
  options.levels = {kLevel};
  const FrequencyBounds bounds =
      frequencyBounds(PlantDistribution(estimate), omega, options, configuration.estimation.seed);
  const UncertaintyBands& bands = bounds.magnitude_bands;
  result->mixture.add(score(bands.mixture.pointwise.front(), fresh, omega));
  if (!bands.total.empty()) result->total.add(score(bands.total.pointwise.front(), fresh, omega));
  result->mixtures.push_back(estimate.error_model.mixture);
  addNominal(bounds.magnitude, result);
  if (result->first.lower.size() == 0) result->first = bands.mixture.pointwise.front();
}

/// Model error modelling from one data set.
inline void addModelErrorModel(Configuration configuration,
                               const std::vector<Experiment>& experiments,
                               const Eigen::VectorXd& omega, const Eigen::ArrayXXd& fresh,
                               MethodResult* result) {
  configuration.bounds.grid = omega;
  configuration.bounds.levels = {kLevel};
  const BaselineResult found = identifyBaseline(BaselineMethod::mem, configuration, experiments);
  addParameters(found.estimate, result);
  const Eigen::VectorXd& deviation = found.baseline.deviation;
  for (Eigen::Index k = 0; k < deviation.size(); ++k) {
    result
        ->parameters["deviation of " +
                     found.baseline.fits[0].parameters[static_cast<std::size_t>(k)].name]
        .values.push_back(deviation[k]);
  }
  const Band& band = found.baseline.magnitude_bands.pointwise.front();
  result->mixture.add(score(band, fresh, omega));
  addNominal(magnitudesOf(PlantDistribution(found.estimate).nominal(), omega), result);
  if (result->first.lower.size() == 0) result->first = band;
}

}  // namespace uncertainty_identification::paper
