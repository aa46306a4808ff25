#include "own_simulation/describe_errors.h"

#include <cmath>

#include "data/text.h"

namespace uncertainty_identification {
namespace {

/// "name value unit (lower to upper)"; empty where the number is not told.
std::string part(const std::string& name, const ErrorNumber& number, const std::string& unit) {
  if (!std::isfinite(number.value)) return "";
  return name + " " + rounded(number.value) + unit + " (" + rounded(number.lower) + " to " +
         rounded(number.upper) + ")";
}

}  // namespace

std::string describe(const SimulationErrors& errors) {
  std::string told;
  for (const std::string& next :
       {part("fit", errors.fit, " %"), part("bias", errors.bias, ""), part("gain", errors.gain, ""),
        part("delay error", errors.delay, " s")})
    if (!next.empty()) told += (told.empty() ? "" : ", ") + next;
  std::string all = told.empty() ? "" : "The simulation has " + told + ".";
  for (const std::string& reason : errors.untold) all += (all.empty() ? "" : " ") + reason;
  return all;
}

}  // namespace uncertainty_identification
