#include "curves/search_time.h"

namespace uncertainty_identification {

SearchTime::SearchTime(const SimulationSearchOptions& options) : options_(options) {}

double SearchTime::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
}

bool SearchTime::goesOn() {
  const std::lock_guard<std::mutex> lock(telling_);
  cancelled_ = cancelled_ || (options_.progress && !options_.progress(doing_));
  const bool may_confirm = purpose_ == Purpose::confirming && share_ == 1;
  const double limit = options_.time_limit * (may_confirm ? 2 : share_);
  return !cancelled_ && (limit <= 0 || seconds() < limit);
}

CurveSearchContext SearchTime::context(WorkerPool* pool) {
  CurveSearchContext context;
  context.pool = pool;
  context.going_on = [this] { return goesOn(); };
  context.tell = [this](const std::string& what) {
    const std::lock_guard<std::mutex> lock(telling_);
    doing_ = what;
  };
  return context;
}

}  // namespace uncertainty_identification
