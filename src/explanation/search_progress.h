#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "estimation/stopwatch.h"
#include "explanation/refine.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// The progress and the time of one explanation. May be used from several threads; the callback is
/// called from one at a time.
class SearchProgress {
 public:
  /// `time_limit` [s] counts from here; 0: none.
  SearchProgress(ProgressCallback callback, double time_limit)
      : callback_(std::move(callback)), time_limit_(time_limit) {}

  /// False once the caller has cancelled.
  bool report(const std::string& phase, double fraction, std::optional<double> log_likelihood);

  /// The same of the search for causes; false also once the time limit has passed.
  bool reportSearch(double log_likelihood);

  /// Tells the share of that search that is done, 0 to 1, or what it fits.
  void tellShare(double share);
  void tellFitting(const std::string& what);

  /// Reports the last progress once more.
  bool repeat();

  bool cancelled() const { return cancelled_; }

  /// Elapsed time [s].
  double seconds() const { return watch_.seconds(); }

  /// False once the time limit has passed, or endSearch() was called.
  bool inTime();
  void endSearch() { out_of_time_ = true; }

  /// Whether the search was ended by time before it was complete.
  bool outOfTime() const { return out_of_time_; }

 private:
  const ProgressCallback callback_;
  const double time_limit_;
  const Stopwatch watch_;
  std::mutex mutex_;  // guards last_ and keeps calls apart
  Progress last_;
  std::mutex sharing_;         // guards the next two
  double share_searched_ = 0;  ///< of the search for causes
  std::string fitting_;        ///< what it fits
  std::atomic<bool> cancelled_{false}, out_of_time_{false};
};

/// The context of fits that go on while the search may, from a likelihood that is reached.
FitContext reportingTo(SearchProgress* progress, double reached, FitContext context);

}  // namespace uncertainty_identification
