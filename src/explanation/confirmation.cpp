#include "explanation/confirmation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "data/text.h"
#include "explanation/named_causes.h"

namespace uncertainty_identification {
namespace {

bool isClear(const LastThirds& gains) {
  constexpr double kClear = 6, kBetter = 0.8;  // [nats], of the squared error
  return gains.log_density > kClear && gains.first > kClear && gains.error_ratio < kBetter;
}

std::string ofLastThirds(const LastThirds& gains) {
  return "no experiment is held out; fitted again to the first two thirds of each record, the "
         "model with the cause makes the last third more likely by " +
         rounded(gains.log_density) + " nats and its simulation error " +
         rounded(100 * std::sqrt(gains.error_ratio)) + " % of that without";
}

/// The only structural cause; null where there are none or several.
const Cause* singleCause(const std::vector<Cause>& causes) {
  const auto cause = std::find_if(causes.begin(), causes.end(), isStructural);
  return std::count_if(causes.begin(), causes.end(), isStructural) == 1 ? &*cause : nullptr;
}

}  // namespace

bool isFoundTwice(const Explanation& explanation) {
  const Cause* cause = singleCause(explanation.causes);
  const std::vector<std::string>& withheld = explanation.simulation.withheld;
  return cause && !cause->simulation &&
         std::find(withheld.begin(), withheld.end(), cause->name) != withheld.end();
}

bool hasUnnamedCurves(const Explanation& explanation) {
  return explanation.causes.empty() && !explanation.simulation.causes.empty();
}

std::string confirmationOf(const std::optional<LastThirds>& last_thirds,
                           const Explanation& explanation) {
  const bool explains_all =
      explanation.verdict == Verdict::explained && singleCause(explanation.causes);
  return explains_all && last_thirds && isClear(*last_thirds) ? ofLastThirds(*last_thirds) : "";
}

}  // namespace uncertainty_identification
