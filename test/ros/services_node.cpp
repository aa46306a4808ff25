// The services of the node, and what it does with bad parameters.

#include <gtest/gtest.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <thread>

#include "io/read_file.h"
#include "ros/message_conversions.h"
#include "ros/parameters.h"
#include "support/example1.h"
#include "support/node_client.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

using messages::GetResult;
using messages::Identify;
using messages::ListExperiments;
using messages::SampleModels;

class ServicesTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(client_.waitForNode());
    ASSERT_TRUE(trigger("reset"));
    ASSERT_TRUE(waitFor([this] { return command_.getNumSubscribers() > 0; }));
    ASSERT_TRUE(waitFor([this] { return measurement_.getNumSubscribers() > 0; }));
  }

  bool trigger(const std::string& name) {
    const auto response = client_.call<std_srvs::Trigger>(name);
    EXPECT_FALSE(response.message.empty());
    return response.success != 0;
  }

  // Publishes an experiment, stamped from now on, and waits until its stamps have passed.
  void publish(const Experiment& experiment) {
    const ros::Time begin = ros::Time::now();
    messages::Sample sample;
    for (int k = 0; k < experiment.samples(); ++k) {
      sample.header.stamp = begin + ros::Duration(k * experiment.sample_time);
      sample.value = experiment.u[k];
      command_.publish(sample);
      sample.value = experiment.y[k];
      measurement_.publish(sample);
    }
    ros::Time::sleepUntil(begin + ros::Duration(experiment.samples() * experiment.sample_time));
  }

  std::size_t listed() {
    return client_.call<ListExperiments>("list_experiments").experiments.size();
  }

  Identify::Request requestWith(int experiments) {
    Identify::Request request;
    for (const auto& experiment : example1Experiments(experiments))
      request.experiments.push_back(toMessage(experiment));
    return request;
  }

  NodeClient client_;
  ros::NodeHandle node_;
  ros::Publisher command_ = node_.advertise<messages::Sample>("/actuator/command", 1000);
  ros::Publisher measurement_ = node_.advertise<messages::Sample>("/sensor/measurement", 1000);
};

TEST_F(ServicesTest, ExperimentsAreCutByServices) {
  EXPECT_EQ(client_.call<GetResult>("get_result").code, GetResult::Response::NONE_YET);
  EXPECT_FALSE(trigger("finish_experiment"));
  std::uint32_t stored = 0;
  for (const auto& experiment : example1Experiments(4)) {
    ASSERT_TRUE(trigger("start_experiment"));
    EXPECT_FALSE(trigger("start_experiment"));
    publish(experiment);
    ASSERT_TRUE(trigger("finish_experiment"));
    ASSERT_TRUE(client_.waitUntilStored(++stored)) << client_.status().message;
  }
  const auto list = client_.call<ListExperiments>("list_experiments").experiments;
  ASSERT_EQ(list.size(), 4U);
  for (const auto& experiment : list) {
    EXPECT_EQ(experiment.samples, 100U);
    EXPECT_NEAR(experiment.sample_time, 0.01, 1e-9);
    EXPECT_EQ(experiment.rejected, "");
  }
  ASSERT_TRUE(waitFor([&] { return client_.status().sequence > 0; })) << client_.status().message;
  const auto answer = client_.call<GetResult>("get_result");
  EXPECT_EQ(answer.code, GetResult::Response::OK);
  EXPECT_GT(answer.result.experiment_count, 0U);
}

// Every result gets its bounds, and plants can be drawn from it.
TEST_F(ServicesTest, ResultsHaveBoundsAndPlants) {
  EXPECT_EQ(client_.call<SampleModels>("sample_models").code, SampleModels::Response::NONE_YET);
  const Latest<messages::UncertaintyBounds> bounds("/identification/uncertainty_bounds");
  const Latest<messages::IdentificationResult> result("/identification/result");
  for (const auto& experiment : example1Experiments(4)) {
    ASSERT_TRUE(trigger("start_experiment"));
    publish(experiment);
    ASSERT_TRUE(trigger("finish_experiment"));
  }
  ASSERT_TRUE(waitFor([&] {
    const auto last = result.get();
    return last.experiment_count == 4 && !last.preliminary &&
           bounds.get().sequence == last.sequence;
  })) << client_.status().message;
  const messages::UncertaintyBounds of = bounds.get();
  const std::size_t levels = of.levels.size(), points = of.omega.size();
  ASSERT_GE(levels, 1U);
  EXPECT_EQ(points, 500U);
  ASSERT_EQ(of.magnitude_lower.size(), levels * points);
  EXPECT_EQ(of.step_upper.size(), levels * of.time.size());
  for (std::size_t k = 0; k < points; ++k) {
    EXPECT_LE(of.magnitude_lower[k], of.magnitude_upper[k]);
    EXPECT_LE(of.relative_error[k], of.relative_error_simultaneous[k] * (1 + 1e-6));
  }
  EXPECT_EQ(of.weight_num.size(), of.weight_den.size());
  EXPECT_FALSE(of.weight_num.empty());

  SampleModels::Request request;
  request.count = 7;
  request.seed = 3;
  const auto drawn = client_.call<SampleModels>("sample_models", request);
  EXPECT_EQ(drawn.code, SampleModels::Response::OK) << drawn.message;
  EXPECT_EQ(drawn.sequence, of.sequence);
  EXPECT_EQ(drawn.num.size(), 7 * drawn.numerator_size);
  EXPECT_EQ(drawn.den.size(), 7 * drawn.denominator_size);
  EXPECT_EQ(client_.call<SampleModels>("sample_models", request).num, drawn.num);
  messages::WriteReport::Request report;
  const auto written = client_.call<messages::WriteReport>("write_report", report);
  EXPECT_EQ(written.code, messages::WriteReport::Response::OK) << written.message;
  EXPECT_NE(readFile(written.path).find("Nyquist"), std::string::npos);
  for (const std::string name : {"../a.html", "/tmp/a.html", "a.txt", ".html", "a b.html"}) {
    report.name = name;
    EXPECT_EQ(client_.call<messages::WriteReport>("write_report", report).code,
              messages::WriteReport::Response::REFUSED)
        << name;
  }
  request.count = 10001;
  EXPECT_EQ(client_.call<SampleModels>("sample_models", request).code,
            SampleModels::Response::REQUEST_ERROR);
  request.count = 1;
  request.uncertainty = 2;
  EXPECT_EQ(client_.call<SampleModels>("sample_models", request).code,
            SampleModels::Response::REQUEST_ERROR);
}

TEST_F(ServicesTest, DiscardedExperimentsLeaveNothing) {
  ASSERT_TRUE(trigger("start_experiment"));
  publish(example1Experiments(1).front());
  EXPECT_TRUE(trigger("discard_experiment"));
  EXPECT_FALSE(trigger("discard_experiment"));
  EXPECT_FALSE(trigger("finish_experiment"));
  EXPECT_EQ(listed(), 0U);
}

TEST_F(ServicesTest, ResetForgets) {
  ASSERT_TRUE(trigger("start_experiment"));
  publish(example1Experiments(1).front());
  ASSERT_TRUE(trigger("finish_experiment"));
  ASSERT_TRUE(waitFor([this] { return listed() == 1U; }));
  ASSERT_TRUE(trigger("reset"));
  EXPECT_EQ(listed(), 0U);
  EXPECT_EQ(client_.call<GetResult>("get_result").code, GetResult::Response::NONE_YET);
  EXPECT_TRUE(waitFor([this] { return client_.status().stored_count == 0U; }));
}

TEST_F(ServicesTest, IdentifyGivesWhatTheIdentifierGives) {
  const auto answer = client_.call<Identify>("identify", requestWith(8));
  ASSERT_EQ(answer.code, Identify::Response::OK) << answer.message;
  const Estimate expected =
      Identifier(loadParameters(client_.node())).identify(example1Experiments(8));
  EXPECT_NEAR(answer.result.log_likelihood, expected.log_likelihood,
              1e-9 * std::abs(expected.log_likelihood));
  EXPECT_NEAR(answer.result.nominal_model.b[0], expected.nominal_model.b[0], 1e-9);
  EXPECT_EQ(listed(), 0U);
}

TEST_F(ServicesTest, BadRequestsAreToldByCode) {
  Identify::Request request;
  request.bags = {"data.bag"};
  const auto refused = client_.call<Identify>("identify", request);
  EXPECT_EQ(refused.code, Identify::Response::REFUSED);
  EXPECT_NE(refused.message.find("bag_directory"), std::string::npos);
  EXPECT_EQ(client_.call<Identify>("identify").code, Identify::Response::DATA_ERROR);
}

TEST_F(ServicesTest, LongRequestsBlockNeitherRecordingNorQueries) {
  auto request = requestWith(200);
  request.configuration = "{nominal_model: {orders: auto}, error_model: {taps: auto}}";
  std::atomic<bool> answered{false};
  std::thread requester([&] {
    EXPECT_EQ(client_.call<Identify>("identify", request).code, Identify::Response::OK);
    answered = true;
  });
  EXPECT_EQ(listed(), 0U);
  EXPECT_TRUE(trigger("start_experiment"));
  EXPECT_TRUE(trigger("discard_experiment"));
  EXPECT_EQ(client_.call<GetResult>("get_result").code, GetResult::Response::NONE_YET);
  EXPECT_FALSE(answered);
  requester.join();
}

// What the node says, and how it ends, when started with these parameters.
std::pair<int, std::string> runNode(const std::string& parameters) {
  const TemporaryFolder folder;
  const std::string log = folder / "log";
  const int status =
      std::system((std::string(TOOLS_FOLDER) + "/identification_node __name:=broken " + parameters +
                   " > " + log + " 2>&1")
                      .c_str());
  ros::param::del("/broken");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(log)};
}

TEST(BadParameters, EndTheNodeWithAMessage) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "no parameters under '/broken'"},
      {"_sample_time:=-1", "sample_time: found -1"},
      {"_estimation/tolerence:=0.1", "did you mean estimation.tolerance?"},
      {"_nominal_model/nb:=many", "nominal_model.nb: found 'many'"},
      {"_nominal_model/orders:=auto _store_directory:=/dev/null", "store_directory: '/dev/null'"},
      {"_nominal_model/orders:=auto _input/topic:=bad~name", "bad~name"}};
  for (const auto& [parameters, message] : cases) {
    const auto [status, output] = runNode(parameters);
    EXPECT_EQ(status, 2) << parameters;
    EXPECT_NE(output.find(message), std::string::npos) << output;
  }
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "services_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
