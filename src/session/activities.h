#pragma once

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace uncertainty_identification {

/// Something that a node computes at the moment.
struct Activity {
  std::string what;  ///< in words, e.g. "identifying from 12 experiments"
  double since = 0;  ///< [s] when it began, by the clock of Activities
};

/// What a node computes at the moment, for its status. May be used from any thread.
class Activities {
 public:
  /// `clock` returns the present time [s]; `changed` is called when something begins or ends, by
  /// the thread that does it.
  Activities(std::function<double()> clock, std::function<void()> changed);

  /// Ends the activity when it is destroyed. The Activities must live longer.
  using Token = std::shared_ptr<void>;

  /// Something begins.
  [[nodiscard]] Token begin(const std::string& what);

  /// In the order in which they began.
  std::vector<Activity> running() const;

 private:
  void end(std::list<Activity>::iterator activity);

  const std::function<double()> clock_;
  const std::function<void()> changed_;
  mutable std::mutex mutex_;  // guards running_
  std::list<Activity> running_;
};

}  // namespace uncertainty_identification
