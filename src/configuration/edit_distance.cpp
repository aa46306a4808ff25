#include "configuration/edit_distance.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace uncertainty_identification {

// Wagner-Fischer recursion that keeps one row of the table at a time.
int editDistance(const std::string& from, const std::string& to) {
  std::vector<int> row(to.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= from.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const int replaced = diagonal + (from[i - 1] == to[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[to.size()];
}

}  // namespace uncertainty_identification
