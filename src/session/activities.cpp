#include "session/activities.h"

#include <iterator>
#include <utility>

namespace uncertainty_identification {

Activities::Activities(std::function<double()> clock, std::function<void()> changed)
    : clock_(std::move(clock)), changed_(std::move(changed)) {}

Activities::Token Activities::begin(const std::string& what) {
  const double now = clock_();
  std::list<Activity>::iterator activity;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    activity = running_.insert(running_.end(), {what, now});
  }
  changed_();
  return Token(nullptr, [this, activity](void*) { end(activity); });
}

void Activities::end(std::list<Activity>::iterator activity) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    running_.erase(activity);
  }
  changed_();
}

std::vector<Activity> Activities::running() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {running_.begin(), running_.end()};
}

}  // namespace uncertainty_identification
