#include "live/live_board.h"

#include <algorithm>
#include <utility>

namespace uncertainty_identification {

void LiveBoard::post(const std::string& name, std::string text) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    LivePart& part = parts_[name];
    if (part.text != nullptr && *part.text == text) return;
    part = {name, ++last_version_, std::make_shared<const std::string>(std::move(text))};
  }
  changed_.notify_all();
}

std::vector<LivePart> LiveBoard::partsAfter(std::uint64_t seen,
                                            std::chrono::milliseconds patience) const {
  std::vector<LivePart> parts;
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_for(lock, patience, [&] { return closed_ || last_version_ > seen; });
  if (closed_) return parts;
  for (const auto& [name, part] : parts_) {
    if (part.version > seen) parts.push_back(part);
  }
  std::sort(parts.begin(), parts.end(),
            [](const LivePart& one, const LivePart& other) { return one.version < other.version; });
  return parts;
}

void LiveBoard::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

bool LiveBoard::closed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return closed_;
}

}  // namespace uncertainty_identification
