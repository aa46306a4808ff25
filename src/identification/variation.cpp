#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>

#include "identification/steps.h"
#include "math/constants.h"
#include "math/polynomial.h"
#include "model/modal.h"
#include "model/sensitivity.h"
#include "uncertainty_identification/model/error_basis.h"

/// How the plants differ from experiment to experiment, in words.
namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::string percent(double share) {
  if (!(share < 10)) return "more than 1000 %";
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100 * share);
  return share < 0.1 ? text : std::to_string(std::lround(100 * share)) + " %";
}

std::string inWords(const std::string& parameter) {
  if (parameter == "gain" || parameter == "dead_time")
    return parameter == "gain" ? "gain" : "dead time";
  if (parameter.rfind("tau", 0) == 0) return "time constant " + parameter;
  if (parameter.rfind("omega", 0) == 0) return "resonance frequency " + parameter;
  if (parameter.rfind("zeta", 0) == 0) return "damping " + parameter;
  if (parameter.rfind("residue", 0) == 0 || parameter.rfind("amplitude", 0) == 0)
    return "size " + parameter;
  if (parameter == "feedthrough" || parameter.rfind("phase", 0) == 0 ||
      parameter.rfind("factor", 0) == 0)
    return parameter;
  return "coefficient " + parameter +
         (parameter[0] == 'b' ? " of the numerator" : " of the denominator");
}

std::string ofParameters(const Estimate& estimate) {
  const std::vector<std::string>& names = estimate.error_model.options.parameters;
  const Eigen::MatrixXd covariance = estimate.error_model.mixture.covariance();
  std::string text;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto row = static_cast<Index>(k);
    text += k == 0 ? "the " : k + 1 == names.size() ? " and the " : ", the ";
    text += inWords(names[k]) + (k == 0 ? " differs by " : " by ") +
            percent(std::sqrt(std::max(covariance(row, row), 0.0)));
  }
  return text;
}

/// Relative standard deviations of the static gain and of the poles of modes that vary along
/// directions, by the derivatives with respect to the factors.
std::string ofModes(const Estimate& estimate, const LinearModel& model) {
  const std::vector<ParameterEstimate>& parameters = estimate.nominal_model.parameters;
  VectorXd theta(static_cast<Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k)
    theta[static_cast<Index>(k)] = parameters[k].value;
  const ModalParameters modes = modalParameters(estimate.configuration.nominal_model,
                                                estimate.nominal_model.sample_time, theta);
  const Eigen::MatrixXd covariance = estimate.error_model.mixture.covariance();
  const auto byXi = [&](const Eigen::MatrixXd& by_theta) {
    Eigen::MatrixXd by(by_theta.rows(), covariance.rows());
    Index column = 0;
    for (const std::string& varied : estimate.error_model.options.parameters) {
      const auto k = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const auto& each) { return each.name == varied; }) -
                     parameters.begin();
      by.col(column++) = by_theta.col(k) * theta[k];
    }
    return by;
  };
  const Eigen::MatrixXd by_xi = byXi(modes.by_theta);
  const auto deviation = [&](const Eigen::RowVectorXd& by, double value) {
    return std::sqrt(std::max((by * covariance * by.transpose()).value(), 0.0)) / std::abs(value);
  };
  std::vector<std::string> differences;
  const auto tell = [&](const std::string& name, double relative) {
    if (relative < 1) differences.push_back("the " + inWords(name) + " by " + percent(relative));
  };
  const Polynomials p = model.nominal().polynomials(theta);
  const Eigen::MatrixXd of_plant = model.nominal().jacobian(theta);
  const double rest = 1 + p.a.sum(), gain = p.b.sum() / rest;
  const Eigen::RowVectorXd gain_by =
      (of_plant.topRows(p.b.size()).colwise().sum() -
       gain * of_plant.middleRows(p.b.size(), p.a.size()).colwise().sum()) /
      rest;
  tell("gain", deviation(byXi(gain_by), gain));
  for (std::size_t k = 0; k < modes.names.size(); ++k) {
    const std::string& name = modes.names[k];
    const auto row = static_cast<Index>(k);
    if (name.rfind("tau", 0) == 0 || name.rfind("omega", 0) == 0 || name.rfind("zeta", 0) == 0)
      tell(name, deviation(by_xi.row(row), modes.values[row]));
  }
  if (differences.empty()) return "the modes differ";
  std::string text;
  for (std::size_t k = 0; k < differences.size(); ++k)
    text += (k == 0 ? "" : k + 1 == differences.size() ? " and " : ", ") + differences[k];
  const std::size_t by = text.find(" by ");
  return text.insert(by, " differs");
}

/// Standard deviation of GDelta at a frequency [rad/sample], from Cov(eta).
double deviationAt(const ErrorBasis& basis, const Eigen::MatrixXd& covariance, double omega) {
  const Eigen::VectorXcd f =
      basis.T().transpose().cast<std::complex<double>>() * basis.responses(std::polar(1.0, -omega));
  const std::complex<double> variance = f.dot(covariance.cast<std::complex<double>>() * f);
  return std::sqrt(std::max(variance.real(), 0.0));
}

std::string ofFilters(const Estimate& estimate, const ErrorBasis& basis) {
  constexpr int kFrequencies = 100;
  constexpr double kPassband = 0.1;  // of the largest |Go|
  const Eigen::MatrixXd covariance = estimate.error_model.mixture.covariance();
  const NominalModelEstimate& go = estimate.nominal_model;
  const auto gain = [&go](double omega) {
    const std::complex<double> z = std::polar(1.0, -omega);
    std::complex<double> b = 0, power = 1;
    for (Index k = 0; k < go.b.size(); ++k, power *= z) b += go.b[k] * power;
    return std::abs(b / (1.0 + z * valueAt(go.a, z)));
  };
  double largest = 0, at = 0, highest = 0;
  for (int k = 1; k <= kFrequencies; ++k) highest = std::max(highest, gain(k * kPi / kFrequencies));
  for (int k = 1; k <= kFrequencies; ++k) {
    const double omega = k * kPi / kFrequencies;
    const double deviation = deviationAt(basis, covariance, omega);
    if (gain(omega) < kPassband * highest || deviation <= largest) continue;
    largest = deviation;
    at = omega / go.sample_time;
  }
  char frequency[32];
  std::snprintf(frequency, sizeof frequency, "%.3g", at);
  return "the static gain differs by " + percent(deviationAt(basis, covariance, 0)) +
         " and the frequency response by up to " + percent(largest) + " at " + frequency + " rad/s";
}

/// Whether the spread is as good as none, as at the lower limit of its covariance.
bool isImmaterial(const Estimate& estimate, const ErrorBasis& basis) {
  constexpr double kMaterial = 1e-4;
  const Eigen::MatrixXd of_eta =
      basis.T() * estimate.error_model.mixture.covariance() * basis.T().transpose();
  return std::sqrt(of_eta.diagonal().maxCoeff()) < kMaterial;
}

const std::string kNoDifference = "The experiments show no difference between their plants.";

}  // namespace

bool plantsDiffer(const Estimate& estimate) {
  constexpr double kClearly = 20;  // of BIC
  if (estimate.variation.empty() || estimate.variation.rfind(kNoDifference, 0) == 0) return false;
  const auto equal = std::find_if(
      estimate.candidates.begin(), estimate.candidates.end(), [](const Candidate& each) {
        return each.choice == "error model" && each.description == "none" && each.bic;
      });
  return equal == estimate.candidates.end() || *equal->bic > estimate.bic + kClearly;
}

std::string variationText(const Estimate& estimate, const LinearModel& model) {
  if (estimate.experiment_count < 2) return "";
  const bool own = estimate.configuration.estimation.offsets == Offsets::per_experiment;
  const std::string offsets = own ? " Each experiment has an offset of its own." : "";
  if (model.regressors() == 0 || isImmaterial(estimate, model.basis()))
    return kNoDifference + offsets;
  const bool varies = variesParameters(estimate.error_model.options.basis);
  return "From experiment to experiment " +
         (variesAlongDirections(estimate.configuration) ? ofModes(estimate, model)
          : varies                                      ? ofParameters(estimate)
                                                        : ofFilters(estimate, model.basis())) +
         " (standard deviation)." + offsets;
}

}  // namespace uncertainty_identification
