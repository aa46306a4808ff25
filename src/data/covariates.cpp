#include "data/covariates.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/clean_signal.h"

namespace uncertainty_identification {
namespace {

StampedSignal finitePart(const StampedSignal& signal) {
  StampedSignal finite;
  for (std::size_t i = 0; i < std::min(signal.stamps.size(), signal.values.size()); ++i) {
    if (!std::isfinite(signal.values[i])) continue;
    finite.stamps.push_back(signal.stamps[i]);
    finite.values.push_back(signal.values[i]);
  }
  return finite;
}

}  // namespace

void addCovariate(const std::string& name, Eigen::VectorXd values, Experiment& experiment) {
  if (values.size() == 0) return;
  if ((values.array() == values(0)).all()) {
    experiment.scalars[name] = values(0);
  } else {
    experiment.signals[name] = std::move(values);
  }
}

void addCovariates(const Recording& recording, const std::vector<double>& instants,
                   Experiment& experiment) {
  for (const auto& [name, signal] : recording.covariates) {
    const StampedSignal finite = finitePart(signal);
    if (finite.stamps.empty()) continue;
    const CleanSignal clean =
        cleanSignal(finite, recording.id, "covariate '" + name + "'", Duplicates::keep_last);
    Eigen::VectorXd values(experiment.samples());
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      const double instant = instants[static_cast<std::size_t>(k)];
      const double tolerance = stampTolerance(instant, experiment.sample_time);
      const auto newest = std::max<std::ptrdiff_t>(0, clean.newestAt(instant + tolerance));
      values(k) = clean.values[static_cast<std::size_t>(newest)];
    }
    addCovariate(name, std::move(values), experiment);
  }
}

}  // namespace uncertainty_identification
