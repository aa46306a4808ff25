#include "session/bag_name.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMost = std::uintmax_t{4} << 30;  // [bytes]

class BagNameTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(directory_ + "/day");
    std::ofstream(directory_ + "/a.bag") << "x";
    std::ofstream(directory_ + "/day/b.bag") << "x";
    std::ofstream(directory_ + "/notes.txt") << "x";
    std::ofstream(folder_ / "secret.bag") << "x";
  }

  std::string resolve(const std::string& name) { return resolveBagName(directory_, name, kMost); }
  std::string refusal(const std::string& name) {
    return messageOf<RefusedError>([&] { resolve(name); });
  }

  TemporaryFolder folder_;
  std::string directory_ = folder_ / "bags";
};

TEST_F(BagNameTest, FindsBagsBelowTheDirectory) {
  EXPECT_EQ(resolve("a.bag"), fs::canonical(directory_ + "/a.bag"));
  EXPECT_EQ(resolve("day/b.bag"), fs::canonical(directory_ + "/day/b.bag"));
  EXPECT_EQ(resolve("./day/./b.bag"), fs::canonical(directory_ + "/day/b.bag"));
}

TEST_F(BagNameTest, RefusesAllNamesWithoutADirectory) {
  EXPECT_NE(
      messageOf<RefusedError>([] { resolveBagName("", "a.bag", kMost); }).find("bag_directory"),
      std::string::npos);
}

TEST_F(BagNameTest, RefusesWhatLeadsOut) {
  EXPECT_NE(refusal("../secret.bag").find("without '..'"), std::string::npos);
  EXPECT_NE(refusal("day/../../secret.bag").find("without '..'"), std::string::npos);
  EXPECT_NE(refusal(folder_ / "secret.bag").find("below bag_directory"), std::string::npos);
  EXPECT_NE(refusal("").find("below bag_directory"), std::string::npos);
  fs::create_symlink(folder_ / "secret.bag", directory_ + "/link.bag");
  EXPECT_NE(refusal("link.bag").find("leads out"), std::string::npos);
  fs::create_directory_symlink(folder_.path(), directory_ + "/out");
  EXPECT_NE(refusal("out/secret.bag").find("leads out"), std::string::npos);
  fs::create_directories(folder_ / "bags2");
  std::ofstream(folder_ / "bags2/c.bag") << "x";
  fs::create_symlink(folder_ / "bags2/c.bag", directory_ + "/near.bag");
  EXPECT_NE(refusal("near.bag").find("leads out"), std::string::npos);
}

TEST_F(BagNameTest, LinksWithinTheDirectoryAreFine) {
  fs::create_symlink(directory_ + "/day/b.bag", directory_ + "/link.bag");
  EXPECT_EQ(resolve("link.bag"), fs::canonical(directory_ + "/day/b.bag"));
}

TEST_F(BagNameTest, RefusesOverLargeFiles) {
  fs::resize_file(directory_ + "/a.bag", kMost);  // sparse: takes no room
  EXPECT_NO_THROW(resolve("a.bag"));
  fs::resize_file(directory_ + "/a.bag", kMost + 1);
  EXPECT_NE(refusal("a.bag").find("limits.max_bag_size"), std::string::npos);
}

TEST_F(BagNameTest, WhatIsNoBagIsNamed) {
  EXPECT_NE(messageOf<FileError>([&] { resolve("absent.bag"); }).find("No such file"),
            std::string::npos);
  EXPECT_THROW(resolve("notes.txt"), FileError);
  EXPECT_THROW(resolve("day"), FileError);
  EXPECT_THROW(resolveBagName(folder_ / "absent", "a.bag", kMost), FileError);
}

}  // namespace
}  // namespace uncertainty_identification
