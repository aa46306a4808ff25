#include "session/node_status.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

TEST(NodeState, IsTheFirstOfThoseThatApply) {
  NodeStatus node;
  RecorderStatus recorder;
  EXPECT_EQ(stateOf(node, recorder), NodeState::idle);
  node.store_problem = "the disk is full";
  EXPECT_EQ(stateOf(node, recorder), NodeState::error);
  node.store_problem.clear();
  node.worker.failed = true;
  EXPECT_EQ(stateOf(node, recorder), NodeState::error);
  recorder.running = true;
  EXPECT_EQ(stateOf(node, recorder), NodeState::collecting);
  node.worker.busy = true;
  EXPECT_EQ(stateOf(node, recorder), NodeState::identifying);
}

}  // namespace
}  // namespace uncertainty_identification
