// Detects from live signals whether the plant still agrees with the identified model. See
// docs/fault_detection.md; config/fault_detection.yaml describes the configuration.

#include <ros/ros.h>

#include <exception>

#include "io/fault_detection_yaml.h"
#include "ros/fault_detection_server.h"
#include "ros/parameters.h"

int main(int argc, char** argv) {
  namespace ui = uncertainty_identification;
  ros::init(argc, argv, "fault_detection");
  // Created outside the try block: ROS logs nothing without a node handle.
  const ros::NodeHandle node, private_node("~");
  try {
    const ui::FaultDetectionServer server(
        node, private_node, ui::parseFaultDetection(ui::loadParameterTree(private_node)));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
  return 0;
}
