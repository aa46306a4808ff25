#include "session/node_status.h"

namespace uncertainty_identification {

NodeState stateOf(const NodeStatus& node, const RecorderStatus& recorder) {
  if (node.worker.busy) return NodeState::identifying;
  if (recorder.running) return NodeState::collecting;
  return node.worker.failed || !node.store_problem.empty() ? NodeState::error : NodeState::idle;
}

}  // namespace uncertainty_identification
