#include "explanation/search_progress.h"

#include <algorithm>

namespace uncertainty_identification {

bool SearchProgress::report(const std::string& phase, double fraction,
                            std::optional<double> log_likelihood) {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_ = {phase, fraction, log_likelihood};
  if (!cancelled_ && callback_ && !callback_(last_)) cancelled_ = true;
  return !cancelled_;
}

bool SearchProgress::reportSearch(double log_likelihood) {
  const std::lock_guard<std::mutex> lock(sharing_);
  return report("searching causes" + fitting_, 0.3 + 0.6 * share_searched_, log_likelihood) &&
         inTime();
}

void SearchProgress::tellShare(double share) {
  const std::lock_guard<std::mutex> lock(sharing_);
  share_searched_ = std::max(share_searched_, share);
  fitting_.clear();
}

void SearchProgress::tellFitting(const std::string& what) {
  const std::lock_guard<std::mutex> lock(sharing_);
  fitting_ = ": fitting " + what;
}

bool SearchProgress::repeat() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!cancelled_ && callback_ && !callback_(last_)) cancelled_ = true;
  return !cancelled_;
}

bool SearchProgress::inTime() {
  if (time_limit_ > 0 && seconds() > time_limit_) out_of_time_ = true;
  return !out_of_time_;
}

FitContext reportingTo(SearchProgress* progress, double reached, FitContext context) {
  context.going_on = [=] { return progress->reportSearch(reached); };
  context.options.on_iterate = [ask = context.going_on](const TracePoint&) { return ask(); };
  context.report_searched = [=](double share) { progress->tellShare(share); };
  context.report_fitted = [=](const std::string& what) { progress->tellFitting(what); };
  return context;
}

}  // namespace uncertainty_identification
