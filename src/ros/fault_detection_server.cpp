#include "ros/fault_detection_server.h"

#include <std_msgs/Bool.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "ros/deserialise.h"
#include "ros/message_conversions.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {
namespace {

/// The configuration of a recorder that cuts the signals into pieces of this duration [s].
Configuration recorderConfiguration(const FaultDetectionConfiguration& configuration,
                                    double duration) {
  Configuration of_recorder;
  of_recorder.input = configuration.input;
  of_recorder.output = configuration.output;
  of_recorder.experiment.mode = ExperimentMode::duration;
  of_recorder.experiment.duration = duration;
  return of_recorder;
}

Estimate estimateOf(const messages::IdentificationResult& result) {
  const auto json = nlohmann::json::parse(result.result_json, nullptr, false);
  if (json.is_discarded())
    throw ConfigurationError("result_json of an identification result is not JSON");
  return estimateFromJson(json);
}

messages::FaultStatus toMessage(const StampedFaultWindow& found) {
  const FaultWindow& window = found.window;
  const WindowProbabilities& probabilities = window.probabilities;
  messages::FaultStatus message;
  message.header.stamp = toStamp(found.end, "a window");
  message.fault = window.fault;
  message.statistic = window.statistic;
  message.threshold = window.threshold;
  for (int i = 0; i < kWindowTests; ++i) {
    message.tests.emplace_back(nameOf(static_cast<WindowTest>(i)));
    message.test_probabilities.push_back(probabilities.tests[i]);
  }
  message.strongest = nameOf(probabilities.strongest);
  message.component_probabilities = window.component_probabilities;
  message.error_mean.assign(window.error_mean.data(),
                            window.error_mean.data() + window.error_mean.size());
  message.window_start = toStamp(found.start, "a window");
  message.window_samples = static_cast<std::uint32_t>(window.last - window.first + 1);
  return message;
}

}  // namespace

FaultDetectionServer::FaultDetectionServer(const ros::NodeHandle& node,
                                           const ros::NodeHandle& private_node,
                                           const FaultDetectionConfiguration& configuration)
    : node_(node),
      private_node_(private_node),
      configuration_(configuration),
      diagnostics_(node, private_node) {
  configuration_.validate();
  status_ = private_node_.advertise<messages::FaultStatus>("status", 100);
  fault_ = private_node_.advertise<std_msgs::Bool>("fault", 10, true);
  diagnostics_.setHardwareID("none");
  diagnostics_.add("fault detection", [this](diagnostic_updater::DiagnosticStatusWrapper& status) {
    diagnose(status);
  });
  diagnostics_timer_ =
      node_.createWallTimer(ros::WallDuration(diagnostics_.getPeriod()),
                            [this](const ros::WallTimerEvent&) { diagnostics_.force_update(); });
  try {
    for (const SignalOptions* signal : {&configuration_.input, &configuration_.output})
      node_.resolveName(signal->topic);
    if (!configuration_.experiment_topic.empty()) {
      ros::SubscribeOptions options;
      options.initByFullCallbackType<const Event&>(configuration_.experiment_topic, 1000,
                                                   [this](const Event& event) { mark(event); });
      markers_ = node_.subscribe(options);
    }
  } catch (const ros::InvalidNameException& error) {
    throw ConfigurationError(std::string("a topic of the configuration: ") + error.what());
  }
  result_ = node_.subscribe<messages::IdentificationResult>(
      "identification/result", 1,
      [this](const messages::IdentificationResult::ConstPtr& result) { adopt(*result); });
}

void FaultDetectionServer::adopt(const messages::IdentificationResult& result) {
  try {
    const Estimate estimate = estimateOf(result);
    if (detector_) {
      detector_->adopt(estimate);
    } else {
      detector_ = std::make_unique<LiveFaultDetector>(estimate, configuration_);
      if (last_marker_) detector_->addMarker(last_marker_->stamp, last_marker_->active);
    }
  } catch (const std::exception& error) {
    report("the identification's result " + std::to_string(result.sequence) +
           " cannot be used: " + error.what());
    return;
  }
  problem_.clear();
  sequence_ = result.sequence;
  last_window_.reset();
  windows_ = alarms_ = 0;
  for (const auto& warning : detector_->detector().warnings()) report(warning);
  if (!recorder_ || recorder_sample_time_ != detector_->detector().sampleTime()) record();
  diagnostics_.force_update();
}

void FaultDetectionServer::record() {
  recorder_sample_time_ = detector_->detector().sampleTime();
  recorder_ = std::make_unique<ExperimentRecorder>(
      node_, private_node_, recorderConfiguration(configuration_, detector_->pieceDuration()),
      ExperimentRecorder::Listener{[this](const FinishedExperiment& piece) { take(piece); },
                                   [this](const std::string& problem) { report(problem); },
                                   [](bool) {}},
      ExperimentRecorder::Patience::a_second);
}

void FaultDetectionServer::mark(const Event& event) {
  const auto& message = *event.getConstMessage();
  std::vector<std::uint8_t> bytes(message.size());
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  message.write(stream);
  const RawMessage raw{message.getDataType(),
                       message.getMD5Sum(),
                       message.getMessageDefinition(),
                       {bytes.data(), bytes.size()},
                       event.getReceiptTime().toSec()};
  try {
    Marker marker{raw.receipt, false};
    if (raw.type == ros::message_traits::datatype<std_msgs::Bool>()) {
      marker.active = deserialise<std_msgs::Bool>(raw).data != 0;
    } else {
      const auto found = deserialise<messages::ExperimentMarker>(raw);
      marker = {found.header.stamp.toSec(), found.active != 0};
    }
    last_marker_ = marker;
    ++marker_count_;
    if (detector_) detector_->addMarker(marker.stamp, marker.active);
  } catch (const Error& error) {
    report(std::string("experiment.topic: ") + error.what());
  }
}

void FaultDetectionServer::take(const FinishedExperiment& finished) {
  if (const auto* rejected = std::get_if<RejectedExperiment>(&finished)) {
    report(rejected->reason);
    detector_->interrupt();
  } else if (const auto* piece = std::get_if<Recording>(&finished)) {
    try {
      for (const StampedFaultWindow& found : detector_->add(*piece)) publish(found);
    } catch (const Error& error) {
      report(error.what());
    }
  }
}

void FaultDetectionServer::publish(const StampedFaultWindow& found) {
  messages::FaultStatus message = toMessage(found);
  message.sequence = sequence_;
  message.window_measured = static_cast<std::uint32_t>(configuration_.detection.window);
  status_.publish(message);
  std_msgs::Bool flag;
  flag.data = found.window.fault;
  fault_.publish(flag);
  const bool changed = !last_window_ || last_window_->fault != found.window.fault;
  if (changed && found.window.fault)
    ROS_WARN_STREAM("fault: statistic " << message.statistic << " above " << message.threshold
                                        << ", strongest test " << message.strongest);
  ++windows_;
  alarms_ += found.window.fault ? 1 : 0;
  last_window_ = found.window;
  if (changed) diagnostics_.force_update();
}

void FaultDetectionServer::report(const std::string& problem) {
  if (problem_ != problem) ROS_WARN_STREAM(problem);
  problem_ = problem;
}

void FaultDetectionServer::diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  using Level = diagnostic_msgs::DiagnosticStatus;
  if (!detector_) {
    status.summary(Level::WARN, problem_.empty() ? "no identification result yet" : problem_);
    return;
  }
  if (last_window_ && last_window_->fault) {
    status.summaryf(Level::ERROR, "fault: strongest test %s",
                    nameOf(last_window_->probabilities.strongest));
  } else if (!problem_.empty()) {
    status.summary(Level::WARN, problem_);
  } else if (last_window_) {
    status.summary(Level::OK, "no fault");
  } else {
    status.summary(Level::OK,
                   detector_->active() ? "no window is complete yet" : "no experiment is running");
  }
  status.add("result sequence", sequence_);
  status.add("markers", marker_count_);
  status.add("windows", windows_);
  status.add("alarms", alarms_);
  status.add("statistic", last_window_ ? last_window_->statistic : 0.0);
  status.add("threshold", detector_->detector().threshold());
}

}  // namespace uncertainty_identification
