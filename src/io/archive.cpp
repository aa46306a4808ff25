#include "io/archive.h"

namespace uncertainty_identification {

void Archive::visit(std::map<std::string, double>& values) {
  const std::vector<std::string> found = beginMap();
  if (reads()) {
    values.clear();
    for (const std::string& key : found) values[key] = 0;
  }
  for (auto& [key, value] : values) (*this)(key, value);
}

}  // namespace uncertainty_identification
