#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "curves/explain_simulation.h"
#include "curves/search_context.h"
#include "curves/window_search.h"

namespace uncertainty_identification {

/// How long the searches of one call may take, and what they tell meanwhile.
class SearchTime {
 public:
  explicit SearchTime(const SimulationSearchOptions& options);

  /// Ends the next searches when this share of the limit is over, counted from the beginning. With
  /// all of it, those that confirm what was found end when twice of it is.
  void allow(double share) { share_ = share; }
  void setPurpose(Purpose purpose) { purpose_ = purpose; }

  double seconds() const;                        ///< since the beginning
  CurveSearchContext context(WorkerPool* pool);  ///< refers to this

 private:
  bool goesOn();

  const SimulationSearchOptions& options_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  double share_ = 1;
  Purpose purpose_ = Purpose::looking;
  std::mutex telling_;  // the context is used by all threads
  bool cancelled_ = false;
  std::string doing_ = "simulating";
};

}  // namespace uncertainty_identification
