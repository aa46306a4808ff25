#include "session/once_per_cause.h"

#include <regex>

namespace uncertainty_identification {
namespace {

/// The warning without what differs from case to case. Other names in quotes are kept, because they
/// are topics and files.
std::string causeOf(const std::string& warning) {
  static const std::regex kExperiment("experiment '[^']*'"), kQuoted("'[^']*'"),
      kNumber("[-+]?[0-9][0-9.]*([eE][-+]?[0-9]+)?|\\bnan\\b|[-+]?\\binf\\b");
  const std::string text =
      std::regex_replace(warning.substr(0, 1000), kExperiment, "an experiment");
  std::string cause;
  auto from = text.cbegin();
  for (std::smatch quoted; std::regex_search(from, text.cend(), quoted, kQuoted);
       from = quoted.suffix().first) {
    cause += std::regex_replace(quoted.prefix().str(), kNumber, "#") + quoted.str();
  }
  return cause + std::regex_replace(std::string(from, text.cend()), kNumber, "#");
}

}  // namespace

bool OncePerCause::isNew(const std::string& warning) {
  constexpr std::size_t kMost = 100;
  const std::string cause = causeOf(warning);
  const std::lock_guard<std::mutex> lock(mutex_);
  return causes_.size() < kMost && causes_.insert(cause).second;
}

void OncePerCause::forget(const std::string& warning) {
  const std::string cause = causeOf(warning);
  const std::lock_guard<std::mutex> lock(mutex_);
  causes_.erase(cause);
}

void OncePerCause::forget() {
  const std::lock_guard<std::mutex> lock(mutex_);
  causes_.clear();
}

}  // namespace uncertainty_identification
