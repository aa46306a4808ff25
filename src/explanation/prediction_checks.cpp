#include "explanation/prediction_checks.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "explanation/residual_checks.h"
#include "identification/steps.h"

namespace uncertainty_identification {
const char* const kDirection = "direction";

namespace {

Check checkNamed(const std::string& name, const std::vector<FailedTest>& failed) {
  Check check;
  check.name = name + " of predictions";
  const auto test = std::find_if(failed.begin(), failed.end(),
                                 [&](const FailedTest& each) { return each.name == name; });
  if (test == failed.end()) return check;
  check.p_value = test->p_value;
  check.passed = !(test->p_value < kCheckThreshold);
  return check;
}

}  // namespace

void addFailedPredictions(Explanation* explanation) {
  const std::vector<FailedTest> before = failedTests(explanation->before.residual_tests),
                                after = failedTests(explanation->after.residual_tests);
  for (const char* name : {"whiteness", "dependence on the input", "linearity"}) {
    const Check without = checkNamed(name, before), with = checkNamed(name, after);
    if (without.passed && with.passed) continue;
    explanation->checks_before.push_back(without);
    explanation->checks_after.push_back(with);
  }
}

void addUnclearDirection(const Following& following, bool delay_is_chosen,
                         Explanation* explanation) {
  const int delay = explanation->before.nominal_model.delay;
  const bool is_unclear =
      delay > 0 ? following.at_once.matters() : delay_is_chosen && following.moveTogether();
  if (!is_unclear) return;
  Check check;
  check.name = kDirection;
  check.statistic = following.at_once.correlation;
  check.p_value = following.at_once.matters() ? following.at_once.p_value : std::nan("");
  check.passed = false;
  check.where = "input and output move within the same reading";
  explanation->checks_before.push_back(check);
  explanation->checks_after.push_back(check);
}

}  // namespace uncertainty_identification
