#pragma once

#include <cstdint>

#include "session/experiment_set.h"

namespace uncertainty_identification {

/// What a node states with a result beside the estimate itself.
struct ResultContext {
  std::uint64_t stamp = 0;     ///< [ns] since 1970, when the result was published first
  std::uint32_t sequence = 0;  ///< number of the result, counted from 1 by the node
  bool preliminary = false;    ///< it started from the result before (IdentificationWorker)
  ExperimentWindow window;     ///< the experiments that were given, usable or not
};

}  // namespace uncertainty_identification
