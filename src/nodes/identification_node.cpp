// Identifies from live topics; docs and config/reference.yaml say how to configure it.

#include <ros/ros.h>

#include <exception>

#include "ros/identification_server.h"
#include "ros/parameters.h"

int main(int argc, char** argv) {
  namespace ui = uncertainty_identification;
  ros::init(argc, argv, "identification");
  const ros::NodeHandle node,
      private_node("~");  // outlive the try: without a node nothing is logged
  try {
    const ui::IdentificationServer server(node, private_node, ui::loadParameters(private_node));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
  return 0;
}
