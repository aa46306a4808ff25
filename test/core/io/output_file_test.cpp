#include "io/output_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

class OutputFile : public testing::Test {
 protected:
  OutputFile() {
    fs::create_directory(folder_ / "data");
    std::ofstream(data_) << "t,u,y\n";
  }

  std::string refusal(const std::string& output, const std::vector<std::string>& inputs) const {
    return messageOf<FileError>([&] { requireWritable(output, inputs); });
  }

  const TemporaryFolder folder_;
  const std::string data_ = folder_ / "data/run.csv";
};

TEST_F(OutputFile, IsNoneOfTheInputsHoweverItIsSpelled) {
  fs::create_symlink(data_, folder_ / "link.json");
  fs::create_hard_link(data_, folder_ / "hard.json");
  for (const std::string& output :
       {data_, folder_ / "data/../data/run.csv", folder_ / "link.json", folder_ / "hard.json"}) {
    EXPECT_EQ(
        refusal(output, {"none.yaml", data_}),
        output + ": is to be written and is also read (" + data_ + "); name another output file");
    EXPECT_NE(refusal(output, {folder_ / "data"}).find("also read (" + data_), std::string::npos);
  }
}

TEST_F(OutputFile, IsNamedOnce) {
  const auto refusal_of = [](const std::vector<std::string>& outputs) {
    return messageOf<FileError>([&] { requireDistinct(outputs); });
  };
  const std::string file = folder_ / "new.yaml", same = folder_ / "data/../new.yaml";
  EXPECT_NE(refusal_of({file, same}).find(same + ": is named for two outputs"), std::string::npos);
  std::ofstream(folder_ / "page.html") << "x";
  fs::create_hard_link(folder_ / "page.html", folder_ / "link.html");
  EXPECT_NE(refusal_of({folder_ / "page.html", file, folder_ / "link.html"}), "no exception");
  EXPECT_EQ(refusal_of({file, folder_ / "page.html"}), "no exception");
  EXPECT_EQ(refusal_of({"/dev/null", "/dev/null"}), "no exception");
  EXPECT_EQ(refusal_of({}), "no exception");
}

TEST_F(OutputFile, MayLieBesideTheInputs) {
  std::ofstream(folder_ / "data/result.json") << "{}";
  EXPECT_EQ(refusal(folder_ / "data/result.json", {data_, folder_ / "data"}), "no exception");
  EXPECT_EQ(refusal(folder_ / "data/new.json", {data_, folder_ / "data"}), "no exception");
}

TEST_F(OutputFile, TwoNewFilesAreComparedByTheirPath) {
  EXPECT_NE(refusal(folder_ / "new.csv", {folder_ / "data/../new.csv"}), "no exception");
  EXPECT_EQ(refusal(folder_ / "new.csv", {folder_ / "other.csv"}), "no exception");
}

TEST_F(OutputFile, MayBeAPipeOrADevice) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(refusal(folder_ / "pipe", {data_}), "no exception");
  EXPECT_EQ(refusal("/dev/null", {data_}), "no exception");
}

}  // namespace
}  // namespace uncertainty_identification
