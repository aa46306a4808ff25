// Archives that are FMUs, and what only looks like one.
#include "fmu/unpacked_fmu.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "support/error_message.h"
#include "support/fmu_builder.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

class UnpackedFmuTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!readsFmus()) GTEST_SKIP() << "built without libzip or tinyxml2";
  }

  std::string refusal() const {
    return messageOf<FileError>([this] { UnpackedFmu unpacked(path_); });
  }

  void expectRefusal(const std::string& part) const {
    const std::string message = refusal();
    EXPECT_EQ(message.find(path_ + ": "), 0u) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_ / "motor.fmu";
};

TEST_F(UnpackedFmuTest, LeavesNothingBehind) {
  test::FmuRecipe recipe;
  recipe.more = {{"resources/table.txt", "1 2 3"}, {"documentation/index.html", "unused"}};
  test::buildFmu(path_, recipe);
  std::string unpacked_to;
  {
    const UnpackedFmu fmu(path_);
    unpacked_to = fmu.folder();
    EXPECT_TRUE(fs::exists(fmu.library()));
    EXPECT_TRUE(fs::exists(fs::path(fmu.folder()) / "resources/table.txt"));
    EXPECT_FALSE(fs::exists(fs::path(fmu.folder()) / "documentation"));
    const UnpackedFmu again(fmu.folder());
    EXPECT_EQ(again.folder(), fmu.folder()) << "a folder stays where it is";
  }
  EXPECT_FALSE(fs::exists(unpacked_to));
}

TEST_F(UnpackedFmuTest, RefusesWhatIsNoFmu) {
  expectRefusal("cannot be read as an FMU, which is a zip archive: No such file");
  std::ofstream(path_) << "no archive at all";
  expectRefusal("Not a zip archive");
}

TEST_F(UnpackedFmuTest, NeedsItsDescriptionAndItsLibrary) {
  test::FmuRecipe recipe;
  recipe.without = {"modelDescription.xml"};
  test::buildFmu(path_, recipe);
  expectRefusal("it has no modelDescription.xml, so it is no FMU");
  recipe.without = {"binaries/linux64/motor.so"};
  recipe.more = {{"binaries/win64/motor.dll", "for another machine"}};
  test::buildFmu(path_, recipe);
  expectRefusal("it has no library motor.so for this machine in binaries/");
  recipe.without = {};
  recipe.description = "<fmiModelDescription";
  test::buildFmu(path_, recipe);
  expectRefusal("modelDescription.xml is no XML");
}

TEST_F(UnpackedFmuTest, WritesNothingOutsideItsFolder) {
  for (const char* name : {"../escaped.txt", "resources/../../escaped.txt", "/tmp/escaped.txt"}) {
    test::FmuRecipe recipe;
    recipe.more = {{name, "escaped"}};
    test::buildFmu(path_, recipe);
    expectRefusal("would lie outside the FMU");
    EXPECT_FALSE(fs::exists(fs::temp_directory_path() / "escaped.txt")) << name;
  }
}

TEST_F(UnpackedFmuTest, SaysThatADamagedArchiveIsOne) {
  test::FmuRecipe recipe;
  recipe.more = {{"resources/noise.bin", std::string(200000, 'x')}};
  test::buildFmu(path_, recipe);
  fs::resize_file(path_, fs::file_size(path_) / 2);
  expectRefusal(": ");
}

}  // namespace
}  // namespace uncertainty_identification
