#include "ros/start_checks.h"

#include <gtest/gtest.h>
#include <ros/names.h>

#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

std::string resolve(const std::string& topic) { return ros::names::resolve("/", topic); }

class StartChecksTest : public testing::Test {
 protected:
  std::string refusal() {
    return messageOf<ConfigurationError>([&] {
      requireFolders(configuration_);
      requireTopics(configuration_, resolve);
    });
  }

  Configuration configuration_;
};

TEST_F(StartChecksTest, ABadNameOfATopicIsNamedWithItsKey) {
  configuration_.input.topic = "a b";
  EXPECT_EQ(refusal().rfind("input.topic: found 'a b'", 0), 0U) << refusal();
  configuration_.input.topic = "a";
  configuration_.output.topic = "1?";
  EXPECT_EQ(refusal().rfind("output.topic: found '1?'", 0), 0U) << refusal();
  configuration_.output.topic = "b";
  configuration_.experiment.topic = "//-";
  EXPECT_EQ(refusal().rfind("experiment.topic: found '//-'", 0), 0U) << refusal();
}

TEST_F(StartChecksTest, TheInputIsNotTheOutput) {
  configuration_.input.topic = "/joint";
  configuration_.output.topic = "joint";
  EXPECT_EQ(refusal().rfind("output.field: found 'auto' of topic '/joint'", 0), 0U) << refusal();
}

TEST_F(StartChecksTest, FoldersMustBeThere) {
  const TemporaryFolder folder;
  configuration_.bag_directory = folder.path();
  configuration_.report_directory = folder / "absent";
  EXPECT_EQ(refusal(), "report_directory: found '" + configuration_.report_directory +
                           "', which is no folder; create it, or leave the key out");
}

TEST_F(StartChecksTest, OtherFieldsOfOneTopicAreAllowed) {
  configuration_.input.topic = configuration_.output.topic = "joint";
  configuration_.input.field = "effort[0]";
  EXPECT_EQ(refusal(), "no exception");
}

}  // namespace
}  // namespace uncertainty_identification
