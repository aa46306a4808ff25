// Identifies from live topics. config/reference.yaml describes the configuration.

#include <ros/ros.h>

#include <exception>

#include "ros/identification_server.h"
#include "ros/parameters.h"
#include "ros/start_checks.h"

int main(int argc, char** argv) {
  namespace ui = uncertainty_identification;
  ros::init(argc, argv, "identification");
  // Created outside the try block: ROS logs nothing without a node handle.
  const ros::NodeHandle node, private_node("~");
  try {
    const ui::Configuration parameters = ui::loadParameters(private_node);
    ui::requireFolders(parameters);
    const ui::IdentificationServer server(node, private_node, parameters);
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
  return 0;
}
