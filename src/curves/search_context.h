#pragma once

#include <functional>
#include <string>

#include "curves/window_fit.h"
#include "math/worker_pool.h"

namespace uncertainty_identification {

/// What the search needs beside the data.
struct CurveSearchContext {
  WorkerPool* pool = nullptr;
  std::function<bool()> going_on;  ///< false: end with the best so far; called from all threads
  /// Shapes that are not named at a place; may be empty.
  std::function<bool(Place, const std::string& shape)> excluded;
  std::function<void(const std::string&)> tell;  ///< what is being done; may be empty

  FitLimits limits(int iterations) const { return {iterations, 2e-4, going_on}; }
};

}  // namespace uncertainty_identification
