#include "data/unmeasured_start.h"

#include <algorithm>
#include <utility>

namespace uncertainty_identification {
Experiment withoutFirst(int samples, Experiment experiment) {
  const Eigen::Index left = experiment.samples() - samples;
  for (Eigen::VectorXd* signal : {&experiment.u, &experiment.y, &experiment.stamp_offset})
    if (signal->size() > 0) *signal = signal->tail(left).eval();
  for (auto& [name, values] : experiment.signals) values = values.tail(left).eval();
  if (!experiment.valid.empty())
    experiment.valid.erase(experiment.valid.begin(), experiment.valid.begin() + samples);
  experiment.start_time += samples * experiment.sample_time;
  return experiment;
}

int samplesBeforeFirstMeasured(const Experiment& experiment) {
  int first = 0;
  while (first < experiment.samples() && !experiment.isValid(first)) ++first;
  return first;
}

std::vector<Experiment> fromFirstMeasured(std::vector<Experiment> experiments,
                                          std::vector<std::string>* remarks) {
  constexpr int kMaterial = 20;  // of the experiment's samples, one in so many
  int shortened = 0, most = 0;
  for (Experiment& experiment : experiments) {
    const int first = samplesBeforeFirstMeasured(experiment);
    if (first == 0 || first == experiment.samples()) continue;
    if (first * kMaterial > experiment.samples()) {
      ++shortened;
      most = std::max(most, first);
    }
    experiment = withoutFirst(first, std::move(experiment));
  }
  if (shortened > 0)
    remarks->push_back(std::to_string(shortened) + " of " + std::to_string(experiments.size()) +
                       " experiments are used from their first measured output on; up to " +
                       std::to_string(most) + " samples before it are left out");
  return experiments;
}

}  // namespace uncertainty_identification
