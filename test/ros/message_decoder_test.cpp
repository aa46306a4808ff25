#include "ros/message_decoder.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/serialization.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>
#include <std_msgs/Header.h>
#include <std_msgs/String.h>

#include <random>

#include "ros/messages.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Buffer = std::vector<std::uint8_t>;

template <typename Message>
Buffer serialise(const Message& message) {
  Buffer buffer(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(buffer.data(), static_cast<std::uint32_t>(buffer.size()));
  ros::serialization::serialize(stream, message);
  return buffer;
}

template <typename Message>
std::shared_ptr<const MessageDefinition> definitionOf() {
  return std::make_shared<MessageDefinition>(ros::message_traits::datatype<Message>(),
                                             ros::message_traits::definition<Message>());
}

template <typename Message>
double read(const Message& message, const std::string& path, const std::string& topic = "/topic") {
  const Buffer buffer = serialise(message);
  return MessageDecoder(definitionOf<Message>(), path, topic).value({buffer.data(), buffer.size()});
}

template <typename Action>
std::string errorOf(const Action& action) {
  try {
    action();
  } catch (const ConfigurationError& error) {
    return error.what();
  }
  return "no ConfigurationError";
}

std::shared_ptr<const MessageDefinition> parse(const std::string& text) {
  return std::make_shared<MessageDefinition>("robot_msgs/Odometry", text);
}

const char kOdometry[] =
    "# two nested levels\n"
    "Header header  # stamp\n"
    "string child_frame_id\n"
    "uint8 KIND=3\n"
    "string TEXT=a # b\n"
    "TwistWithCovariance twist\n"
    "================================================================================\n"
    "MSG: std_msgs/Header\n"
    "uint32 seq\n"
    "time stamp\n"
    "string frame_id\n"
    "================================================================================\n"
    "MSG: robot_msgs/TwistWithCovariance\n"
    "geometry/Vector3 linear\n"
    "float64[36] covariance\n"
    "\n"
    "================================================================================\n"
    "MSG: geometry/Vector3\n"
    "float64 x\n"
    "float64 y\n";

diagnostic_msgs::DiagnosticArray diagnostics() {
  diagnostic_msgs::DiagnosticArray array;
  array.header.stamp = ros::Time(12, 250000000);
  array.header.frame_id = "frame";
  array.status.resize(2);
  array.status[0].name = "first";
  array.status[0].values.resize(3);
  array.status[0].values[1].key = "a longer key";
  array.status[1].level = 2;
  return array;
}

messages::Experiment experimentMessage() {
  messages::Experiment experiment;
  experiment.header.stamp = ros::Time(3, 500000000);
  experiment.id = "one";
  experiment.u = {1, 2, 3};
  experiment.y = {4, 5, 6};
  experiment.valid = {1, 0, 1};
  experiment.covariates.resize(2);
  experiment.covariates[0].name = "temperature";
  experiment.covariates[0].values = {20.5};
  experiment.covariates[1].values = {7, 8, 9};
  return experiment;
}

TEST(MessageDecoder, ReadsThroughNestedMessagesAndArrays) {
  const auto experiment = experimentMessage();
  EXPECT_EQ(read(experiment, "y[2]"), 6);
  EXPECT_EQ(read(experiment, "valid[1]"), 0);
  EXPECT_EQ(read(experiment, "covariates[1].values[2]"), 9);
  EXPECT_EQ(read(experiment, "header.stamp"), 3.5);
  EXPECT_EQ(read(diagnostics(), "status[1].level"), 2);
}

TEST(MessageDecoder, ReadsEveryBuiltinType) {
  const auto definition = parse(
      "bool a\nint8 b\nbyte c\nuint8 d\nchar e\nint16 f\nuint16 g\nint32 h\nuint32 i\nint64 j\n"
      "uint64 k\nfloat32 l\nfloat64 m\nduration n\ntime o\nstring p\nint8[2] q\n");
  Buffer buffer(53);
  ros::serialization::OStream stream(buffer.data(), static_cast<std::uint32_t>(buffer.size()));
  stream.next(std::uint8_t{1});
  stream.next(std::int8_t{-2});
  stream.next(std::int8_t{-3});
  stream.next(std::uint8_t{200});
  stream.next(std::uint8_t{201});
  stream.next(std::int16_t{-300});
  stream.next(std::uint16_t{60000});
  stream.next(std::int32_t{-70000});
  stream.next(std::uint32_t{4000000000U});
  stream.next(std::int64_t{-5000000000});
  stream.next(std::uint64_t{6000000000});
  stream.next(1.5F);
  stream.next(-2.25);
  buffer.resize(buffer.size() - stream.getLength());
  const auto append = [&buffer](const Buffer& bytes) {
    buffer.insert(buffer.end(), bytes.begin(), bytes.end());
  };
  append(serialise(ros::Duration(-1, 500000000)));
  append(serialise(ros::Time(8, 750000000)));
  append(serialise(std::string("text")));
  append({5, 6});
  const auto value = [&](const std::string& path) {
    return MessageDecoder(definition, path, "/topic").value({buffer.data(), buffer.size()});
  };
  const std::vector<std::pair<std::string, double>> expected = {
      {"a", 1},           {"b", -2},           {"c", -3},          {"d", 200},
      {"e", 201},         {"f", -300},         {"g", 60000},       {"h", -70000},
      {"i", 4000000000.}, {"j", -5000000000.}, {"k", 6000000000.}, {"l", 1.5},
      {"m", -2.25},       {"n", -0.5},         {"o", 8.75},        {"q[1]", 6}};
  for (const auto& [path, number] : expected) EXPECT_EQ(value(path), number) << path;
}

TEST(MessageDecoder, AutomaticFieldIsTheOnlyNumber) {
  std_msgs::Float64 number;
  number.data = 2.5;
  EXPECT_EQ(read(number, "auto"), 2.5);
  messages::Sample sample;
  sample.header.stamp = ros::Time(1, 0);
  sample.header.frame_id = "some frame";
  sample.value = -7;
  EXPECT_EQ(read(sample, "auto"), -7);
}

TEST(MessageDecoder, AutomaticFieldRefusesToGuess) {
  const auto several = errorOf([] { read(experimentMessage(), "auto", "/data"); });
  EXPECT_NE(several.find("'/data' of type uncertainty_identification/Experiment"),
            std::string::npos)
      << several;
  EXPECT_NE(several.find("'sample_time', 'u[0]', 'y[0]'"), std::string::npos) << several;
  EXPECT_NE(errorOf([] { read(std_msgs::String(), "auto"); }).find("no numeric field"),
            std::string::npos);
}

TEST(MessageDecoder, WrongPathListsTheNumericFieldsNearestFirst) {
  const auto definition = parse(kOdometry);
  const auto error = [&](const std::string& path) {
    return errorOf([&] { MessageDecoder(definition, path, "/odom"); });
  };
  const std::string list = "its numeric fields are 'twist.linear.x', ";
  EXPECT_NE(error("twist.liner.x").find(list), std::string::npos) << error("twist.liner.x");
  EXPECT_NE(error("linear.x").find(list), std::string::npos) << error("linear.x");
  for (const std::string path : {"", ".", "twist", "child_frame_id", "twist.linear.x.y",
                                 "twist.covariance", "twist.covariance[36]", "twist.linear[0].x",
                                 "twist.covariance[-1]", "twist.covariance[", "KIND"})
    EXPECT_NE(error(path).find("has no numeric field '" + path + "'"), std::string::npos) << path;
}

TEST(MessageDecoder, FirstComponentMayNameTheTopicOrTheType) {
  const auto experiment = experimentMessage();
  EXPECT_EQ(read(experiment, "rig_data.y[0]", "/lab/rig_data"), 4);
  EXPECT_EQ(read(experiment, "experiment.y[0]", "/other"), 4);
  EXPECT_NE(errorOf([&] { read(experiment, "elsewhere.y[0]", "/other"); }).find("no numeric field"),
            std::string::npos);
}

TEST(MessageDecoder, StampIsThatOfTheLeadingHeader) {
  const auto array = diagnostics();
  const Buffer buffer = serialise(array);
  const MessageDecoder decoder(definitionOf<diagnostic_msgs::DiagnosticArray>(), "status[0].level",
                               "/diagnostics");
  ASSERT_TRUE(decoder.hasStamp());
  EXPECT_EQ(decoder.stamp({buffer.data(), buffer.size()}), 12.25);
  EXPECT_FALSE(MessageDecoder(definitionOf<std_msgs::Float64>(), "auto", "/x").hasStamp());
}

TEST(MessageDecoder, ElementBeyondTheArrayIsToldOnReading) {
  EXPECT_THROW(read(experimentMessage(), "u[3]"), DataError);
}

TEST(MessageDecoder, TruncatedMessagesAreErrors) {
  const Buffer buffer = serialise(experimentMessage());
  const MessageDecoder decoder(definitionOf<messages::Experiment>(), "covariates[1].values[2]",
                               "/topic");
  for (std::size_t size = 0; size < buffer.size() - 4; ++size) {
    const Buffer part(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_THROW(decoder.value({part.data(), part.size()}), DataError) << size;
  }
}

TEST(MessageDecoder, ArrayLengthBeyondTheMessageIsAnError) {
  Buffer buffer = serialise(diagnostics());
  const std::size_t length = 4 + 8 + 4 + 5;  // seq, stamp, frame_id "frame"
  for (std::size_t i = 0; i < 4; ++i) buffer[length + i] = 0xff;
  const MessageDecoder decoder(definitionOf<diagnostic_msgs::DiagnosticArray>(),
                               "status[4000000].level", "/topic");
  EXPECT_THROW(decoder.value({buffer.data(), buffer.size()}), DataError);
}

TEST(MessageDecoder, RandomBytesNeverLeaveTheBuffer) {
  std::mt19937_64 engine(1);
  const Buffer original = serialise(experimentMessage());
  const MessageDecoder decoder(definitionOf<messages::Experiment>(), "covariates[1].values[2]",
                               "/topic");
  int errors = 0;
  for (int run = 0; run < 20000; ++run) {
    Buffer buffer = original;
    for (int change = 0; change < 3; ++change)
      buffer[engine() % buffer.size()] = static_cast<std::uint8_t>(engine());
    try {
      decoder.value({buffer.data(), buffer.size()});
    } catch (const DataError&) {
      ++errors;
    }
  }
  EXPECT_GT(errors, 1000);
}

TEST(MessageDefinition, RefusesWhatIsNoDefinition) {
  const std::vector<std::string> texts = {
      "float64",
      "float64 x y",
      "Missing x\n",
      "float64[x] y\n",
      "float64[1 y\n",
      "Loop x\n===\nMSG: robot_msgs/Loop\nLoop x\n",
      "===\nno type name\n",
      "Large[999999999] x\n===\nMSG: robot_msgs/Large\nfloat64[999999999] y\n"};
  for (const auto& text : texts) EXPECT_THROW(parse(text), DataError) << text;
}

TEST(MessageDefinition, ExplodingDefinitionsEndQuickly) {
  std::string text = "T0 a\nT0 b\n";
  for (int i = 0; i < 45; ++i)
    text += "===\nMSG: robot_msgs/T" + std::to_string(i) + "\nT" + std::to_string(i + 1) + " a\nT" +
            std::to_string(i + 1) + " b\n";
  text += "===\nMSG: robot_msgs/T45\nstring[0] x\n";
  EXPECT_TRUE(parse(text)->numericFields(false).empty());
  EXPECT_THROW(MessageDecoder(parse(text + "float64[] y\n"), "z", "/topic"), ConfigurationError);
  EXPECT_THROW(parse(text + "float64 y\n"), DataError);
}

TEST(MessageDefinition, ReadsThePackagesOwnMessages) {
  const auto fields = definitionOf<messages::NominalModel>()->numericFields(false);
  EXPECT_NE(std::find(fields.begin(), fields.end(), "parameters[0].value"), fields.end());
  EXPECT_NE(std::find(fields.begin(), fields.end(), "noise_variance"), fields.end());
}

}  // namespace
}  // namespace uncertainty_identification
