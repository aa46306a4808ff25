#include "data/unmeasured_start.h"

#include <algorithm>
#include <utility>

namespace uncertainty_identification {
namespace {

Experiment from(int first, Experiment experiment) {
  const Eigen::Index left = experiment.u.size() - first;
  experiment.start_time += first * experiment.sample_time;
  experiment.u = experiment.u.tail(left).eval();
  experiment.y = experiment.y.tail(left).eval();
  experiment.valid.erase(experiment.valid.begin(), experiment.valid.begin() + first);
  for (auto& [name, signal] : experiment.signals) signal = signal.tail(left).eval();
  if (experiment.stamp_offset.size() > 0)
    experiment.stamp_offset = experiment.stamp_offset.tail(left).eval();
  return experiment;
}

}  // namespace

std::vector<Experiment> fromFirstMeasured(std::vector<Experiment> experiments,
                                          std::vector<std::string>* remarks) {
  constexpr int kMaterial = 20;  // of the experiment's samples, one in so many
  int shortened = 0, most = 0;
  for (Experiment& experiment : experiments) {
    int first = 0;
    while (first < experiment.samples() && !experiment.isValid(first)) ++first;
    if (first == 0 || first == experiment.samples()) continue;
    if (first * kMaterial > experiment.samples()) {
      ++shortened;
      most = std::max(most, first);
    }
    experiment = from(first, std::move(experiment));
  }
  if (shortened > 0)
    remarks->push_back(std::to_string(shortened) + " of " + std::to_string(experiments.size()) +
                       " experiments are used from their first measured output on; up to " +
                       std::to_string(most) + " samples before it are left out");
  return experiments;
}

}  // namespace uncertainty_identification
