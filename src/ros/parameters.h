#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// Converts ROS parameters to the tree that a configuration file gives. `path` is the key of
/// `value`. Throws ConfigurationError, naming the key, for binary values and dates, which no key
/// accepts.
YAML::Node toYaml(XmlRpc::XmlRpcValue value, const std::string& path = "");

/// The parameters of a node as a tree, without the keys that ROS libraries own. The tree is empty
/// if the node has no parameters. Throws ConfigurationError like toYaml().
YAML::Node loadParameterTree(const ros::NodeHandle& node);

/// The configuration given by a node's parameters. Keys that ROS libraries own (diagnostic_period
/// and those of actionlib) are left out. Throws ConfigurationError like parseConfiguration().
Configuration parseParameters(const XmlRpc::XmlRpcValue& parameters);

/// Reads the configuration from the parameter server. Throws ConfigurationError also when the
/// namespace holds no parameters.
Configuration loadParameters(const ros::NodeHandle& node);

}  // namespace uncertainty_identification
