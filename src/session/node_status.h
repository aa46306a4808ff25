#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "session/activities.h"
#include "session/identification_worker.h"

namespace uncertainty_identification {

/// What the recording of a node tells for its status.
struct RecorderStatus {
  bool running = false;               ///< whether an experiment is being recorded
  std::vector<std::string> problems;  ///< messages for the user about the topics
};

/// What the other parts of a node tell for its status.
struct NodeStatus {
  WorkerStatus worker;
  std::string store_problem;      ///< why the store cannot be written; empty: nothing is wrong
  std::vector<Activity> running;  ///< what is computed now, by the ROS clock
  int waiting_requests = 0;       ///< requests and goals that wait until another one has ended
  std::uint32_t sequence = 0;     ///< number of the last result
};

enum class NodeState { idle, collecting, identifying, error };

/// Of the states that apply the first of: identifying, collecting, error, idle.
NodeState stateOf(const NodeStatus& node, const RecorderStatus& recorder);

}  // namespace uncertainty_identification
