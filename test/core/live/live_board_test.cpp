#include "live/live_board.h"

#include <gtest/gtest.h>

#include <thread>

namespace uncertainty_identification {
namespace {

using std::chrono::milliseconds;

std::vector<std::string> namesAfter(const LiveBoard& board, std::uint64_t seen) {
  std::vector<std::string> names;
  for (const LivePart& part : board.partsAfter(seen, milliseconds(0))) names.push_back(part.name);
  return names;
}

TEST(LiveBoard, GivesTheNewestTextOfEachPartInTheOrderOfPosting) {
  LiveBoard board;
  EXPECT_TRUE(namesAfter(board, 0).empty());
  board.post("status", "1");
  board.post("result", "2");
  board.post("status", "3");
  const auto parts = board.partsAfter(0, milliseconds(0));
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].name, "result");
  EXPECT_EQ(parts[1].name, "status");
  EXPECT_EQ(*parts[1].text, "3");
  EXPECT_EQ(namesAfter(board, parts[0].version), std::vector<std::string>{"status"});
  EXPECT_TRUE(namesAfter(board, parts[1].version).empty());
}

TEST(LiveBoard, TheSameTextIsNoChange) {
  LiveBoard board;
  board.post("status", "1");
  const std::uint64_t seen = board.partsAfter(0, milliseconds(0)).back().version;
  board.post("status", "1");
  EXPECT_TRUE(namesAfter(board, seen).empty());
}

TEST(LiveBoard, AReaderWaitsForAChangeOrTheEnd) {
  LiveBoard board;
  std::thread poster([&board] { board.post("status", "1"); });
  const auto parts = board.partsAfter(0, std::chrono::minutes(2));
  poster.join();
  ASSERT_EQ(parts.size(), 1U);
  std::thread closer([&board] { board.close(); });
  EXPECT_TRUE(board.partsAfter(parts[0].version, std::chrono::minutes(2)).empty());
  closer.join();
  EXPECT_TRUE(board.closed());
}

}  // namespace
}  // namespace uncertainty_identification
