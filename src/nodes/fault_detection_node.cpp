// Tells from live signals whether a plant still is one that the identified model allows;
// docs/fault_detection.md and config/fault_detection.yaml say how to configure it.

#include <ros/ros.h>

#include <exception>

#include "io/fault_detection_yaml.h"
#include "ros/fault_detection_server.h"
#include "ros/parameters.h"

int main(int argc, char** argv) {
  namespace ui = uncertainty_identification;
  ros::init(argc, argv, "fault_detection");
  const ros::NodeHandle node,
      private_node("~");  // outlive the try: without a node nothing is logged
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
