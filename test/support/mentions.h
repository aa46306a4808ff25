#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace uncertainty_identification {
namespace test {

inline bool mentions(const std::string& message, const std::string& part) {
  return message.find(part) != std::string::npos;
}

inline bool anyMentions(const std::vector<std::string>& messages, const std::string& part) {
  return std::any_of(messages.begin(), messages.end(),
                     [&](const std::string& message) { return mentions(message, part); });
}

}  // namespace test
}  // namespace uncertainty_identification
