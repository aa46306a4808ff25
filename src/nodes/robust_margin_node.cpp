// Judges a controller against every new model and its uncertainty; docs/robust_margin.md and
// config/robust_margin.yaml say how to configure it.

#include <ros/ros.h>

#include <exception>

#include "io/robust_margin_yaml.h"
#include "ros/parameters.h"
#include "ros/robust_margin_server.h"

int main(int argc, char** argv) {
  namespace ui = uncertainty_identification;
  ros::init(argc, argv, "robust_margin");
  const ros::NodeHandle node,
      private_node("~");  // outlive the try: without a node nothing is logged
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
