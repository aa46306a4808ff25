#include "uncertainty_identification/effects/effect.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

VectorXd sorted(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

double deviation(const std::vector<double>& values) {
  const Eigen::Map<const Eigen::ArrayXd> all(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  return values.empty() ? 1.0 : std::sqrt((all - all.mean()).square().mean());
}

/// The starting times of the experiments; empty unless they rise from each to the next.
VectorXd risingStarts(const std::vector<Experiment>& experiments) {
  VectorXd starts(static_cast<Eigen::Index>(experiments.size()));
  for (Eigen::Index r = 0; r < starts.size(); ++r) {
    starts[r] = experiments[static_cast<std::size_t>(r)].start_time;
    if (r > 0 && !(starts[r] > starts[r - 1])) return VectorXd();
  }
  return starts;
}

/// The means of the covariates that every experiment has and that vary over the data set.
std::map<std::string, double> covariateMeans(const std::vector<Experiment>& experiments) {
  struct Sums {
    double sum = 0, count = 0, lowest = HUGE_VAL, highest = -HUGE_VAL;
    std::size_t experiments = 0;
    void add(const Eigen::ArrayXd& values) {
      sum += values.sum();
      count += static_cast<double>(values.size());
      lowest = std::min(lowest, values.minCoeff());
      highest = std::max(highest, values.maxCoeff());
      ++experiments;
    }
  };
  std::map<std::string, Sums> sums;
  for (const Experiment& experiment : experiments) {
    for (const auto& [name, signal] : experiment.signals) sums[name].add(signal.array());
    for (const auto& [name, value] : experiment.scalars)
      sums[name].add(Eigen::ArrayXd::Constant(1, value));
  }
  std::map<std::string, double> means;
  for (const auto& [name, of] : sums) {
    if (of.experiments == experiments.size() && of.highest > of.lowest && std::isfinite(of.sum))
      means[name] = of.sum / of.count;
  }
  return means;
}

}  // namespace

double sortedQuantile(const VectorXd& sorted, double q) {
  if (sorted.size() == 0) return 0;
  const auto at = static_cast<Eigen::Index>(q * static_cast<double>(sorted.size()));
  return sorted[std::min(at, sorted.size() - 1)];
}

DataSummary summarise(const std::vector<Experiment>& experiments) {
  DataSummary summary;
  std::vector<double> u, y, input_sizes, input_steps, output_sizes;
  for (const Experiment& experiment : experiments) {
    for (int t = 0; t < experiment.samples(); ++t) {
      u.push_back(experiment.u[t]);
      input_sizes.push_back(std::abs(u.back()));
      const double step = t > 0 ? std::abs(u.back() - experiment.u[t - 1]) : 0.0;
      if (step > 0) input_steps.push_back(step);
      if (!experiment.isValid(t)) continue;
      y.push_back(experiment.y[t]);
      output_sizes.push_back(std::abs(y.back()));
    }
    summary.samples = std::max(summary.samples, experiment.samples());
    summary.stamps = summary.stamps || (experiment.stamp_offset.size() > 0 &&
                                        experiment.stamp_offset.cwiseAbs().maxCoeff() >
                                            1e-6 * experiment.sample_time);
  }
  summary.experiments = static_cast<int>(experiments.size());
  if (!experiments.empty()) summary.sample_time = experiments.front().sample_time;
  summary.input_deviation = std::max(deviation(u), 1e-300);
  summary.output_deviation = std::max(deviation(y), 1e-300);
  summary.input_sizes = sorted(std::move(input_sizes));
  summary.input_steps = sorted(std::move(input_steps));
  summary.output_sizes = sorted(std::move(output_sizes));
  summary.covariates = covariateMeans(experiments);
  summary.starts = risingStarts(experiments);
  return summary;
}

std::string Effect::label() const {
  return description_.variant.empty() ? name() : name() + " (" + description_.variant + ")";
}

bool Effect::has(Trait trait) const {
  const std::vector<Trait>& traits = description_.traits;
  return std::find(traits.begin(), traits.end(), trait) != traits.end();
}

bool Effect::admissible(const VectorXd& psi) const {
  for (Eigen::Index i = 0; i < psi.size(); ++i) {
    const EffectParameter& parameter = description_.parameters[static_cast<std::size_t>(i)];
    if (!(psi[i] >= parameter.lower && psi[i] <= parameter.upper)) return false;
  }
  return true;
}

void Effect::apply(const VectorXd& /*psi*/, Chain* /*chain*/) const {
  throw std::logic_error(name() + " has no part in the chain");
}

double Effect::pointAt(double size, const NominalModel& /*nominal*/,
                       const VectorXd& /*theta*/) const {
  return size;
}

std::vector<VectorXd> values(const std::vector<double>& starts, double factor) {
  std::vector<VectorXd> all;
  all.reserve(starts.size());
  for (const double start : starts) all.push_back(VectorXd::Constant(1, factor * start));
  return all;
}

EffectParameter logVariance(const std::string& name, const std::string& unit) {
  return {name, unit, 1, -14, 25, true, true};
}

Lanes Effect::feedback(const VectorXd& /*psi*/, const Lanes& /*x*/, const Lanes& /*before*/) const {
  throw std::logic_error(name() + " has no part in the plant's loop");
}

}  // namespace uncertainty_identification
