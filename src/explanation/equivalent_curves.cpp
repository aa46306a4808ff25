#include "explanation/equivalent_curves.h"

#include <algorithm>
#include <string>
#include <vector>

#include "curves/curve_words.h"
#include "explanation/verdict.h"

namespace uncertainty_identification {
namespace {

bool isAmong(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::string> possibleNames(const SimulationCause& found) {
  std::vector<std::string> names{found.what.name};
  for (const PlaceAndShape& tie : found.ties) names.push_back(tie.name);
  return names;
}

void add(const std::string& name, Cause* cause) {
  if (!name.empty() && name != cause->name && !isAmong(cause->equivalent, name))
    cause->equivalent.push_back(name);
}

}  // namespace

void tellEquivalentCurves(Explanation* explanation) {
  const std::string before = describedNames(explanation->causes);
  for (Cause& cause : explanation->causes) {
    for (const SimulationCause& found : explanation->simulation.causes) {
      const std::vector<std::string> names = possibleNames(found);
      if (!isAmong(names, cause.name)) continue;
      for (const std::string& name : names) add(name, &cause);
    }
    std::vector<std::string> own = cause.equivalent;
    own.push_back(cause.name);
    if (!cause.simulation) add(causeBetween(own), &cause);
  }
  std::string& message = explanation->message;
  if (const std::size_t at = message.find(before); !before.empty() && at != std::string::npos)
    message.replace(at, before.size(), describedNames(explanation->causes));
}

}  // namespace uncertainty_identification
