#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

#include <string>

#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// ROS parameters as the tree that a configuration file gives. Throws ConfigurationError, naming
/// the key `path`, for binary values and dates, which no key takes.
YAML::Node toYaml(XmlRpc::XmlRpcValue value, const std::string& path = "");

/// The parameters of a node as a tree, without the keys that ROS libraries own; no keys where it
/// has none. Throws ConfigurationError as toYaml() does.
YAML::Node loadParameterTree(const ros::NodeHandle& node);

/// The configuration that a node's parameters give, without the keys that ROS libraries own:
/// diagnostic_period, and those of actionlib. Throws ConfigurationError as parseConfiguration()
/// does.
Configuration parseParameters(const XmlRpc::XmlRpcValue& parameters);

/// The same from the parameter server. Throws ConfigurationError as well when the namespace holds
/// no parameters.
Configuration loadParameters(const ros::NodeHandle& node);

}  // namespace uncertainty_identification
