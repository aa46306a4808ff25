#include "ros/explanation_server.h"

#include <gtest/gtest.h>

#include "support/example_explanation.h"

namespace uncertainty_identification {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;
using Status = diagnostic_updater::DiagnosticStatusWrapper;

Status statusOf(const Explanation* explanation) {
  Status status;
  diagnoseExplanation(explanation, status);
  return status;
}

TEST(DiagnoseExplanation, IsGoodUntilSomethingIsFound) {
  EXPECT_EQ(statusOf(nullptr).level, Level::OK);
  EXPECT_EQ(statusOf(nullptr).message, "nothing has been explained yet");
  Explanation none;
  none.message = "nothing is wrong";
  EXPECT_EQ(statusOf(&none).level, Level::OK);
  EXPECT_EQ(statusOf(&none).message, "nothing is wrong");
}

TEST(DiagnoseExplanation, WarnsWithTheCauses) {
  const Explanation found = test::exampleExplanation();
  const Status status = statusOf(&found);
  EXPECT_EQ(status.level, Level::WARN);
  EXPECT_EQ(status.message.rfind("act_deadzone or act_backlash, exp_feedback: ", 0), 0U)
      << status.message;
  ASSERT_GE(status.values.size(), 2U);
  EXPECT_EQ(status.values[0].key, "verdict");
  EXPECT_EQ(status.values[0].value, "partly_explained");
  EXPECT_EQ(status.values[1].key, "act_deadzone");
  EXPECT_EQ(status.values[1].value, "move the actuator slowly through zero");
}

TEST(DiagnoseExplanation, WarnsOfWhatHasNoName) {
  Explanation unknown;
  unknown.verdict = Verdict::unknown;
  unknown.message = "whiteness fails";
  EXPECT_EQ(statusOf(&unknown).level, Level::WARN);
  EXPECT_EQ(statusOf(&unknown).message, "whiteness fails");
}

}  // namespace
}  // namespace uncertainty_identification
