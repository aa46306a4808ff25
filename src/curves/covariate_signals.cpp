#include "curves/covariate_signals.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>

namespace uncertainty_identification {
namespace {

/// Whether the covariate is known at every sample, be it constant over the experiment.
bool isKnown(const Experiment& experiment, const std::string& covariate) {
  return experiment.signals.count(covariate) > 0 || experiment.scalars.count(covariate) > 0;
}

Eigen::VectorXd covariateOf(const Experiment& experiment, const std::string& name) {
  const auto signal = experiment.signals.find(name);
  if (signal != experiment.signals.end()) return signal->second;
  return Eigen::VectorXd::Constant(experiment.samples(), experiment.scalars.at(name));
}

/// Covariates that move within an experiment and are known in all of them.
std::set<std::string> movingCovariates(const std::vector<Experiment>& experiments,
                                       const std::vector<Experiment>& held) {
  std::set<std::string> names;
  for (const Experiment& experiment : experiments)
    for (const auto& [name, signal] : experiment.signals) names.insert(name);
  for (auto name = names.begin(); name != names.end();) {
    const auto is_known = [&](const Experiment& each) { return isKnown(each, *name); };
    const bool everywhere = std::all_of(experiments.begin(), experiments.end(), is_known) &&
                            std::all_of(held.begin(), held.end(), is_known);
    name = everywhere ? std::next(name) : names.erase(name);
  }
  return names;
}

std::string nameOf(const CovariateScale& covariate) {
  if (covariate.lag == 0) return covariate.of;
  std::ostringstream text;
  text.precision(3);
  text << covariate.of << " behind a lag of " << covariate.lag << " s";
  return text.str();
}

}  // namespace

Eigen::VectorXd signalOf(const CovariateScale& covariate, const Experiment& experiment) {
  Eigen::VectorXd signal = covariateOf(experiment, covariate.of);
  if (covariate.lag == 0) return signal;
  const double pole = std::exp(-experiment.sample_time / covariate.lag);
  double state = signal[0];
  for (Eigen::Index k = 0; k < signal.size(); ++k) {
    const double now = signal[k];
    signal[k] = state;
    state = pole * state + (1 - pole) * now;
  }
  return signal;
}

std::map<std::string, CovariateScale> covariateScales(const std::vector<Experiment>& experiments,
                                                      const std::vector<Experiment>& held,
                                                      double lag_unit) {
  constexpr int kLags = 8;
  std::map<std::string, CovariateScale> scales;
  for (const std::string& name : movingCovariates(experiments, held)) {
    for (int k = 0; k <= (lag_unit > 0 ? kLags : 0); ++k) {
      CovariateScale scale;
      scale.of = name;
      scale.lag = k == 0 ? 0 : std::ldexp(lag_unit, k);
      double sum = 0, squares = 0, count = 0;
      for (const Experiment& experiment : experiments) {
        const Eigen::VectorXd signal = signalOf(scale, experiment);
        sum += signal.sum();
        squares += signal.squaredNorm();
        count += experiment.samples();
      }
      static_cast<Scale&>(scale) = scaleOf(sum, squares, count, true);
      scales[nameOf(scale)] = scale;
    }
  }
  return scales;
}

}  // namespace uncertainty_identification
