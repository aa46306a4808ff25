#include "session/checked_json.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "io/read_file.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

json example() {
  return {{"id", "run 1"}, {"numbers", {1.5, -0.1, 1e-300, 3}}, {"flag", true}, {"none", nullptr}};
}

TEST(CheckedJson, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  saveChecked(folder / "a.json", example());
  EXPECT_EQ(loadChecked(folder / "a.json"), example());
}

TEST(CheckedJson, WhatJsonCannotHoldDoesNotCountAsDamage) {
  const TemporaryFolder folder;
  json tree = example();
  tree["id"] = "\xff\xfe";
  tree["not finite"] = std::numeric_limits<double>::quiet_NaN();
  saveChecked(folder / "a.json", tree);
  EXPECT_TRUE(loadChecked(folder / "a.json")["not finite"].is_null());
}

TEST(CheckedJson, FilesWithoutAChecksumAreRead) {
  const TemporaryFolder folder;
  std::ofstream(folder / "old.json") << example().dump(3);
  EXPECT_EQ(loadChecked(folder / "old.json"), example());
  std::ofstream(folder / "list.json") << "[1]";
  EXPECT_EQ(loadChecked(folder / "list.json"), json({1}));
}

/// One changed bit anywhere is an error, or changes nothing that is read.
TEST(CheckedJson, NoChangedBitGoesUnnoticed) {
  const TemporaryFolder folder;
  saveChecked(folder / "a.json", example());
  const std::string written = readFile(folder / "a.json");
  int found = 0;
  for (std::size_t k = 0; k < 8 * written.size(); ++k) {
    std::string changed = written;
    changed[k / 8] = static_cast<char>(changed[k / 8] ^ (1 << k % 8));
    std::ofstream(folder / "b.json", std::ios::binary) << changed;
    try {
      json tree = loadChecked(folder / "b.json");
      for (auto key = tree.begin(); key != tree.end();)  // the name of the checksum has changed
        key = key.key().size() == 8 && example().count(key.key()) == 0 ? tree.erase(key) : ++key;
      EXPECT_EQ(tree, example()) << changed;
    } catch (const FileError&) {
      ++found;
    } catch (const json::exception&) {
      ++found;
    }
  }
  EXPECT_GT(found, 500);
}

}  // namespace
}  // namespace uncertainty_identification
