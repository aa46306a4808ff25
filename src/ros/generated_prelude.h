#pragma once

// Everything that the generated message headers include, so that only they see the macro around
// them.
#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatus.h>
#include <ros/message_operations.h>
#include <ros/service_traits.h>
#include <ros/types.h>
#include <std_msgs/Header.h>

#include <map>
#include <memory>
#include <string>
#include <vector>
