#include "session/file_name.h"

#include <algorithm>
#include <cctype>

namespace uncertainty_identification {

bool isPlainFileName(const std::string& name, const std::string& ending) {
  constexpr std::size_t kLongest = 200;
  return name.size() <= kLongest && name.size() > ending.size() && name[0] != '.' &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0 &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-';
         });
}

}  // namespace uncertainty_identification
