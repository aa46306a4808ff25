#include "uncertainty_identification/data/experiment.h"

#include <algorithm>

namespace uncertainty_identification {

int Experiment::validSamples() const {
  if (valid.empty()) return samples();
  return static_cast<int>(valid.size() -
                          static_cast<std::size_t>(std::count(valid.begin(), valid.end(), 0)));
}

}  // namespace uncertainty_identification
