#include "io/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

class AtomicFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directory(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string contentOf(const std::string& path) const {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    content << file.rdbuf();
    return content.str();
  }
  std::ptrdiff_t files() const {
    return std::distance(std::filesystem::directory_iterator(folder_),
                         std::filesystem::directory_iterator());
  }

  std::string folder_;
};

TEST_F(AtomicFile, WritesAndReplaces) {
  const std::string path = folder_ + "/result.json";
  const std::string content("a\0b\n", 4);
  writeFileAtomically(path, content);
  EXPECT_EQ(contentOf(path), content);
  writeFileAtomically(path, "new");
  EXPECT_EQ(contentOf(path), "new");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFile, HasTheUsualPermissions) {
  const mode_t mask = ::umask(022);
  writeFileAtomically(folder_ + "/file", "x");
  ::umask(mask);
  struct stat status {};
  ASSERT_EQ(::stat((folder_ + "/file").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0644u);
}

TEST_F(AtomicFile, AFailedWriteLeavesTheOldFileAndNoOther) {
  const std::string path = folder_ + "/file";
  writeFileAtomically(path, "old");
  const auto fail = [](const std::string& temporary) {
    std::ofstream(temporary) << "half";
    throw std::runtime_error("interrupted");
  };
  EXPECT_THROW(writeAtomically(path, fail), std::runtime_error);
  EXPECT_EQ(contentOf(path), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFile, TheTemporaryFileLiesInTheSameFolder) {
  const std::string path = folder_ + "/file";
  writeAtomically(path, [&](const std::string& temporary) {
    EXPECT_NE(temporary, path);
    EXPECT_EQ(temporary.rfind(folder_ + "/", 0), 0u);
    std::ofstream(temporary) << "content";
    EXPECT_FALSE(std::filesystem::exists(path));
  });
  EXPECT_EQ(contentOf(path), "content");
}

TEST_F(AtomicFile, ErrorsNameFileAndReason) {
  const auto messageOf = [](const std::string& path) -> std::string {
    try {
      writeFileAtomically(path, "x");
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  };
  const std::string missing = messageOf(folder_ + "/none/file");
  EXPECT_NE(missing.find("'" + folder_ + "/none/file': No such file or directory"),
            std::string::npos)
      << missing;
  std::filesystem::create_directories(folder_ + "/taken/by");
  const std::string taken = messageOf(folder_ + "/taken");
  EXPECT_NE(taken.find("Is a directory"), std::string::npos) << taken;
  EXPECT_EQ(files(), 1);
}

TEST_F(AtomicFile, PipesAreWrittenToAndStayPipes) {
  const std::string path = folder_ + "/pipe";
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  const int reader = ::open(path.c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_GE(reader, 0);
  writeFileAtomically(path, "content");
  char received[16] = {};
  EXPECT_EQ(::read(reader, received, sizeof received), 7);
  EXPECT_STREQ(received, "content");
  ::close(reader);
  EXPECT_TRUE(std::filesystem::is_fifo(path));
  EXPECT_TRUE(isDeviceOrPipe(path));
  EXPECT_FALSE(isDeviceOrPipe(folder_));
  EXPECT_FALSE(isDeviceOrPipe(folder_ + "/none"));
}

TEST_F(AtomicFile, ALinkStaysALinkToTheNewContent) {
  writeFileAtomically(folder_ + "/file", "old");
  std::filesystem::create_symlink("file", folder_ + "/link");
  writeFileAtomically(folder_ + "/link", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ + "/link"));
  EXPECT_EQ(contentOf(folder_ + "/file"), "new");
  EXPECT_EQ(files(), 2);
}

TEST_F(AtomicFile, AWriterThatWritesNothingIsAnError) {
  EXPECT_THROW(writeAtomically(folder_ + "/file", [](const std::string&) {}), FileError);
}

}  // namespace
}  // namespace uncertainty_identification
