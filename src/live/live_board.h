#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace uncertainty_identification {

/// A part of the live page as it is now.
struct LivePart {
  std::string name;                         ///< "status", "result", ...
  std::uint64_t version = 0;                ///< counted from 1 over all parts of a board
  std::shared_ptr<const std::string> text;  ///< JSON
};

/// The newest text of each part of the live page. Those who post never wait for those who read:
/// a reader that is slow finds the newest texts only. May be used from any thread.
class LiveBoard {
 public:
  /// Replaces the text of a part, if it is another one.
  void post(const std::string& name, std::string text);

  /// The parts that were posted after version `seen`, in the order of posting. Waits for at most
  /// `patience` until there is one; empty when there is none by then, or after close().
  std::vector<LivePart> partsAfter(std::uint64_t seen, std::chrono::milliseconds patience) const;

  /// From now on nobody waits.
  void close();

  bool closed() const;

 private:
  mutable std::mutex mutex_;  // guards the members below
  mutable std::condition_variable changed_;
  std::map<std::string, LivePart> parts_;
  std::uint64_t last_version_ = 0;
  bool closed_ = false;
};

}  // namespace uncertainty_identification
