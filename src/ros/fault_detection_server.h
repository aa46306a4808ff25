#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <topic_tools/shape_shifter.h>

#include <memory>
#include <optional>
#include <string>

#include "detection/live_fault_detector.h"
#include "ros/experiment_recorder.h"
#include "ros/messages.h"

namespace uncertainty_identification {

/// The node that detects faults. It uses the newest result of an identification (topic
/// identification/result) and the live signals, and publishes ~status (FaultStatus) for each
/// window, ~fault (std_msgs/Bool, latched) and diagnostics. When a new result arrives, detection
/// starts again with the new model. All callbacks run in the thread that spins.
class FaultDetectionServer {
 public:
  /// Throws ConfigurationError when the configuration is not valid.
  FaultDetectionServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                       const FaultDetectionConfiguration& configuration);

 private:
  using Event = ros::MessageEvent<const topic_tools::ShapeShifter>;

  void adopt(const messages::IdentificationResult& result);
  void mark(const Event& event);
  void record();
  void take(const FinishedExperiment& finished);
  void publish(const StampedFaultWindow& found);
  void report(const std::string& problem);
  void diagnose(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  struct Marker {
    double stamp;
    bool active;
  };

  ros::NodeHandle node_, private_node_;
  FaultDetectionConfiguration configuration_;
  ros::Publisher status_, fault_;
  diagnostic_updater::Updater diagnostics_;
  ros::WallTimer diagnostics_timer_;
  ros::Subscriber result_, markers_;
  std::unique_ptr<LiveFaultDetector> detector_;  ///< null before the first result
  std::unique_ptr<ExperimentRecorder> recorder_;
  double recorder_sample_time_ = 0;    ///< [s] sample time for which the recorder was created
  std::uint32_t sequence_ = 0;         ///< number of the result in use
  std::optional<Marker> last_marker_;  ///< before the first result
  std::optional<FaultWindow> last_window_;
  long windows_ = 0, alarms_ = 0;  ///< counted since the result in use arrived
  long marker_count_ = 0;
  std::string problem_;  ///< the newest problem; empty if there is none
};

}  // namespace uncertainty_identification
