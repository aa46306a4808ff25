// What is said of samples that repeat each other exactly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/example1.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {
namespace {

bool names(const Explanation& explanation, const std::string& name) {
  return std::any_of(explanation.causes.begin(), explanation.causes.end(),
                     [&](const Cause& cause) { return cause.name == name; });
}

TEST(Signatures, ASystemAtRestBeforeTheTestIsNoFault) {
  constexpr int kRest = 20;
  std::vector<Experiment> all = example1Experiments(12);
  for (Experiment& experiment : all) {
    for (Eigen::VectorXd* signal : {&experiment.u, &experiment.y}) {
      const Eigen::VectorXd moving = *signal;
      signal->setZero(kRest + moving.size());
      signal->tail(moving.size()) = moving;
    }
  }
  const Explanation found = explain(example1Configuration(), all);
  EXPECT_FALSE(names(found, "sens_clip"));
  EXPECT_FALSE(names(found, "sens_dropout"));
}

TEST(Signatures, ACoarseSensorWithUnequalStepsDoesNotHang) {
  std::vector<Experiment> all = example1Experiments(12);
  for (Experiment& experiment : all)
    experiment.y = (experiment.y.array() / 5).sinh().unaryExpr([](double y) {
      return std::asinh(std::round(y * 20) / 20) * 5;
    });
  EXPECT_FALSE(names(explain(example1Configuration(), all), "sens_dropout"));
}

TEST(Signatures, ASensorThatHangsIsNamed) {
  std::vector<Experiment> all = example1Experiments(12);
  for (Experiment& experiment : all) {
    for (int t = 30; t < 34; ++t) experiment.y[t] = experiment.y[29];
  }
  EXPECT_TRUE(names(explain(example1Configuration(), all), "sens_dropout"));
}

}  // namespace
}  // namespace uncertainty_identification
