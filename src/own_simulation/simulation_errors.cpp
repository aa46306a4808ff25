#include "own_simulation/simulation_errors.h"

#include <algorithm>
#include <cmath>

#include "math/distributions.h"
#include "own_simulation/delayed_regression.h"

namespace uncertainty_identification {
namespace {

constexpr int kFewestSamples = 30;
constexpr int kLongestShift = 500;     // [samples]
constexpr double kFollows = 3;         // standard errors of a gain beyond which y follows y_sim
constexpr double kStandsStill = 1e-9;  // relative range of a constant signal

/// `value`, with the error of coefficient i of a regression, times `scale`.
ErrorNumber numberOf(double value, const Regression& regression, int i, double scale = 1) {
  const double error = std::abs(scale) * std::sqrt(std::max(regression.variances[i], 0.0));
  const double reach = studentQuantile(0.975, regression.degrees[i]) * error;
  return {value, error, value - reach, value + reach};
}

ErrorNumber coefficientOf(const Regression& regression, int i) {
  return numberOf(regression.coefficients[i], regression, i);
}

bool standsStill(const Eigen::VectorXd& signal) {
  return signal.maxCoeff() - signal.minCoeff() <= kStandsStill * signal.cwiseAbs().maxCoeff();
}

/// By the delta method: the fit is a function of the means of the squared error and of the squared
/// deviation from the mean.
ErrorNumber fitOf(const Eigen::VectorXd& y, const Eigen::ArrayXd& weight,
                  const Eigen::VectorXd& y_sim) {
  const double count = weight.sum();
  const double mean = y.sum() / count;
  const Eigen::ArrayXd error = weight * (y - y_sim).array().square();
  const Eigen::ArrayXd power = weight * (y.array() - mean).square();
  if (!(power.sum() > 0)) return {};
  const double relative = error.sum() / power.sum();
  const double fit = 100 * (1 - std::sqrt(relative));
  const double slope = relative > 0 ? 50 * count / (std::sqrt(relative) * power.sum()) : 0;
  const Eigen::VectorXd change = slope * (error - relative * power);
  return numberOf(fit, regress(weight.matrix(), change), 0);
}

/// Bias, and gain where there is a second column, without a delay.
void tellUndelayed(const Eigen::VectorXd& y, const Eigen::MatrixXd& columns,
                   SimulationErrors* errors) {
  const Regression fit = regress(columns, y);
  errors->bias = coefficientOf(fit, 0);
  if (columns.cols() > 1) errors->gain = coefficientOf(fit, 1);
}

bool follows(const Regression& fit) {
  return std::abs(fit.coefficients[1]) > kFollows * std::sqrt(fit.variances[1]);
}

void tellDelayed(const DelayedRegression& found, double sample_time, SimulationErrors* errors) {
  const Regression& fit = found.of_slopes;
  errors->bias = coefficientOf(fit, 0);
  errors->gain = coefficientOf(fit, 1);
  errors->delay = numberOf(found.delay * sample_time, fit, 2, sample_time / fit.coefficients[1]);
}

/// Bias, gain and delay of a simulation that moves.
void tellMoving(const Eigen::VectorXd& y, const Eigen::ArrayXd& weight,
                const Eigen::VectorXd& y_sim, double sample_time, SimulationErrors* errors) {
  const int most = static_cast<int>(std::min<Eigen::Index>(y.size() / 10, kLongestShift));
  const int start = bestShift(y, weight, y_sim, most);
  const auto found = regressDelayed(y, weight, ShiftedSignal(y_sim), start, most);
  if (found && follows(found->of_slopes)) return tellDelayed(*found, sample_time, errors);
  Eigen::MatrixXd columns(y.size(), 2);
  columns << weight.matrix(), (weight * y_sim.array()).matrix();
  tellUndelayed(y, columns, errors);
  errors->untold.push_back(
      found ? "The delay error is not told, because the output does not follow the simulation."
            : "The delay error is not told: it cannot be told apart from gain and bias with this "
              "motion, or it exceeds a tenth of the experiment or 500 samples.");
}

}  // namespace

SimulationErrors simulationErrors(const Eigen::VectorXd& measured, const Eigen::ArrayXd& weight,
                                  const Eigen::VectorXd& y_sim, double sample_time) {
  SimulationErrors errors;
  errors.samples = static_cast<int>(weight.sum());
  if (errors.samples < kFewestSamples) {
    errors.untold.push_back("Nothing is told of fewer than " + std::to_string(kFewestSamples) +
                            " measured samples; there are " + std::to_string(errors.samples) + ".");
    return errors;
  }
  if (!y_sim.allFinite()) {
    errors.untold.push_back(
        "Nothing is told: the simulation has samples that are NaN or infinite.");
    return errors;
  }
  const Eigen::VectorXd y = (weight > 0).select(measured.array(), 0);
  errors.fit = fitOf(y, weight, y_sim);
  if (std::isnan(errors.fit.value))
    errors.untold.push_back("The fit is not told, because the measured output is constant.");
  if (!standsStill(y_sim)) {
    tellMoving(y, weight, y_sim, sample_time, &errors);
    return errors;
  }
  tellUndelayed(y - (weight * y_sim.array()).matrix(), weight.matrix(), &errors);
  errors.untold.push_back(
      "Gain and delay error are not told, because the simulation stands still.");
  return errors;
}

std::optional<SimulationErrors> simulationErrors(const Experiment& experiment,
                                                 const std::string& name) {
  Eigen::VectorXd y_sim;
  const auto signal = experiment.signals.find(name);
  const auto constant = experiment.scalars.find(name);
  if (signal != experiment.signals.end())
    y_sim = signal->second;
  else if (constant != experiment.scalars.end())
    y_sim = Eigen::VectorXd::Constant(experiment.y.size(), constant->second);
  if (y_sim.size() == 0 || y_sim.size() != experiment.y.size()) return std::nullopt;
  Eigen::ArrayXd weight(experiment.y.size());
  for (int k = 0; k < experiment.samples(); ++k)
    weight[k] = experiment.isValid(k) && std::isfinite(experiment.y[k]) ? 1 : 0;
  SimulationErrors errors = simulationErrors(experiment.y, weight, y_sim, experiment.sample_time);
  errors.id = experiment.id;
  return errors;
}

}  // namespace uncertainty_identification
