#pragma once

#include <mutex>
#include <set>
#include <string>

namespace uncertainty_identification {

/// Tells whether a warning is the first one of its cause. Warnings that differ only in numbers and
/// in the names of experiments have the same cause: a sensor that sends nonsense a thousand times a
/// second is one thing to know. May be used from any thread.
class OncePerCause {
 public:
  /// After 100 different causes the answer is always false, so that memory stays bounded.
  bool isNew(const std::string& warning);

  /// The cause of this warning is new again.
  void forget(const std::string& warning);

  /// From now on every cause is new.
  void forget();

 private:
  std::mutex mutex_;  // guards causes_
  std::set<std::string> causes_;
};

}  // namespace uncertainty_identification
