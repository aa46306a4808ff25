#include "ros/survey_data.h"

#include <gtest/gtest.h>

#include <fstream>

#include "ros/bag_writer.h"
#include "support/error_message.h"
#include "support/mentions.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

class SurveyedData : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& header) const {
    std::ofstream file(folder_ / name);
    file << header << "\n";
    unsigned state = 3;
    double y = 0;
    for (int k = 0; k < 300; ++k) {
      state = 1664525U * state + 1013904223U;
      const int u = state > 0x80000000U ? 1 : -1;
      file << 0.1 * k << "," << u << "," << y << "," << k % 10 << "\n";
      y = 0.8 * y + u;
    }
    return folder_ / name;
  }

  const TemporaryFolder folder_;
};

TEST_F(SurveyedData, JoinsTheFilesOfAFolder) {
  write("a.csv", "t,voltage,speed,x");
  write("b.csv", "t,voltage,speed,temp");
  const InspectedData data = inspectData({folder_.path()}, {}, false);
  EXPECT_EQ(data.survey.streams.size(), 2u);
  ASSERT_EQ(data.survey.channels.size(), 4u);
  EXPECT_EQ(data.measures.size(), 4u);
  EXPECT_EQ(data.measures[0].samples, 600);
  EXPECT_EQ(data.measures[2].samples, 300);
  EXPECT_EQ(data.loaded.experiments.size(), 2u) << data.failure;
  EXPECT_EQ(data.configuration.input.column, "voltage");
}

TEST_F(SurveyedData, SaysWhichFilesCannotBeRead) {
  write("a.csv", "t,u,y,x");
  std::ofstream(folder_ / "b.csv") << "";
  EXPECT_TRUE(test::anyMentions(surveyData({folder_.path()}, {}).remarks, "b.csv"));
  const std::string message = messageOf<FileError>([&] {
    surveyData({folder_ / "b.csv", folder_ / "b.csv"}, {});
  });
  EXPECT_TRUE(test::mentions(message, "nothing could be read\ncannot read")) << message;
  EXPECT_TRUE(test::mentions(messageOf<FileError>([&] { surveyData({folder_ / "c.csv"}, {}); }),
                             "does not exist"));
}

TEST_F(SurveyedData, MovesUnusableExperimentsToTheRejectedOnes) {
  write("a.csv", "t,u,y,x");
  std::ofstream(folder_ / "still.csv") << "t,u,y,x\n0,1,2,3\n0.1,1,2,3\n0.2,1,2,3\n";
  const InspectedData data = inspectData({folder_.path()}, {}, false);
  ASSERT_EQ(data.loaded.experiments.size(), 1u);
  ASSERT_EQ(data.loaded.rejected.size(), 1u);
  EXPECT_EQ(data.loaded.rejected.front().id, "still");
}

TEST_F(SurveyedData, OfUnlikeKindsAreNotOnePlant) {
  Experiment experiment;
  experiment.id = "first";
  experiment.sample_time = 0.1;
  experiment.start_time = 1;
  experiment.u = Eigen::VectorXd::Random(40);
  experiment.y = Eigen::VectorXd::Random(40);
  writeBag(folder_ / "a.bag", {experiment});
  write("b.csv", "t,voltage,speed,x");
  const InspectedData data = inspectData({folder_.path()}, {}, false);
  EXPECT_EQ(data.survey.records, 2u);
  if (data.choice.chosen) {
    const auto& channels = data.survey.channels;
    EXPECT_EQ(channels[data.choice.chosen->input].column.empty(),
              channels[data.choice.chosen->output].column.empty());
  }
}

TEST_F(SurveyedData, NamesSettleWhatIsReadWithoutConfiguration) {
  std::string told;
  const std::string plain = write("plain.csv", "t,u,y,x");
  EXPECT_TRUE(readsByItself({plain}));
  EXPECT_EQ(configurationByNames({plain}, told).input.column, "");
  EXPECT_EQ(told, "");
  const std::string named = write("named.csv", "t,voltage,speed,x");
  EXPECT_FALSE(readsByItself({plain, named}));
  EXPECT_EQ(configurationByNames({named}, told).output.column, "speed");
  EXPECT_TRUE(test::mentions(told, "input: 'voltage' (its name says 'voltage'")) << told;
  EXPECT_TRUE(test::mentions(told, "--config chooses others")) << told;
  const std::string two = write("two.csv", "t,voltage,speed,position");
  const std::string message =
      messageOf<ConfigurationError>([&] { configurationByNames({two}, told); });
  EXPECT_TRUE(test::mentions(message, "the output could be any of 'speed', 'position'")) << message;
}

}  // namespace
}  // namespace uncertainty_identification
