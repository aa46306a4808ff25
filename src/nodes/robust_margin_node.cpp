// Computes the robust margin of a controller with every newly identified model and its uncertainty.
// See docs/robust_margin.md; config/robust_margin.yaml describes the configuration.

#include <ros/ros.h>

#include <exception>

#include "io/robust_margin_yaml.h"
#include "ros/parameters.h"
#include "ros/robust_margin_server.h"

int main(int argc, char** argv) {
  namespace ui = uncertainty_identification;
  ros::init(argc, argv, "robust_margin");
  // Created outside the try block: ROS logs nothing without a node handle.
  const ros::NodeHandle node, private_node("~");
  try {
    const ui::RobustMarginServer server(node, private_node,
                                        ui::parseRobustMargin(ui::loadParameterTree(private_node)));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
  return 0;
}
