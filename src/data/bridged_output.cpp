#include "data/bridged_output.h"

#include <cmath>

namespace uncertainty_identification {

Eigen::VectorXd bridgedOutput(const Experiment& experiment) {
  Eigen::VectorXd y = experiment.y;
  int last = -1;
  for (int k = 0; k < experiment.samples(); ++k) {
    if (!experiment.isValid(k) || !std::isfinite(y[k])) continue;
    for (int j = last + 1; j < k; ++j) {
      y[j] = last < 0 ? y[k] : y[last] + (y[k] - y[last]) * (j - last) / (k - last);
    }
    last = k;
  }
  for (int j = last + 1; j < experiment.samples(); ++j) y[j] = last < 0 ? 0.0 : y[last];
  return y;
}

}  // namespace uncertainty_identification
