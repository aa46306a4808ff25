// Dependencies point one way, and ROS stays in its layer: read from the #include lines of all
// sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

const std::string kPackage = "uncertainty_identification";

/// What the rooms below input and output may use besides the standard library and this package.
const std::vector<std::string> kCoreLibraries{"Eigen/", "unsupported/Eigen/", "boost/math/",
                                              "nlopt.hpp", "sys/"};
const std::vector<std::string> kIoLibraries{"yaml-cpp/", "nlohmann/", "boost/program_options",
                                            "boost/crc.hpp"};

/// Rooms from the lowest; a file may include what is in its own room or in one before it.
const std::vector<std::string> kRooms{
    "math",       "configuration",  "data",    "inspection",     "model",       "effects",
    "estimation", "residual_tests", "bounds",  "identification", "baselines",   "control",
    "detection",  "simulation",     "curves",  "own_simulation", "explanation", "fmu",
    "io",         "export",         "session", "live",           "ros",         "nodes",
    "tools"};

/// Headers in the root of include/ that every room may use.
const std::vector<std::string> kVocabulary{"errors.h", "version.h"};
constexpr int kLowest = -1;

int placeOf(const std::string& room) {
  const auto found = std::find(kRooms.begin(), kRooms.end(), room);
  return found == kRooms.end() ? static_cast<int>(kRooms.size())
                               : static_cast<int>(found - kRooms.begin());
}

/// The place in kRooms of a path relative to include/<package>/ or src/; beyond the last for a
/// folder that is no room.
int layerOf(const std::string& path) {
  if (std::find(kVocabulary.begin(), kVocabulary.end(), path) != kVocabulary.end()) return kLowest;
  if (path == "identifier.h") return placeOf("identification");
  const auto slash = path.find('/');
  return placeOf(slash == std::string::npos ? "configuration" : path.substr(0, slash));
}

struct Include {
  std::string file;      ///< relative to its root
  std::string included;  ///< as written between <> or ""
  bool generated;        ///< <package/...> in angle brackets: a generated message
  bool quoted;           ///< written between ""
};

std::vector<Include> includesBelow(const fs::path& root) {
  static const std::regex directive(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::vector<Include> found;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    std::ifstream in(entry.path());
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (!std::regex_search(line, match, directive)) continue;
      const bool ours = match[2].str().rfind(kPackage + "/", 0) == 0;
      found.push_back({fs::relative(entry.path(), root).string(), match[2], ours && match[1] == "<",
                       match[1] == "\""});
    }
  }
  return found;
}

std::vector<Include> allIncludes() {
  const fs::path project(PROJECT_FOLDER);
  std::vector<Include> all = includesBelow(project / "include" / kPackage);
  for (const Include& include : includesBelow(project / "src")) all.push_back(include);
  return all;
}

bool startsWithOneOf(const std::string& text, const std::vector<std::string>& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(), [&text](const std::string& beginning) {
    return text.rfind(beginning, 0) == 0;
  });
}

/// A header of this package: its path without the package's name; empty for all others.
std::string ownHeader(const Include& include) {
  if (include.generated) return "";
  const std::string prefix = kPackage + "/";
  if (include.included.rfind(prefix, 0) == 0) return include.included.substr(prefix.size());
  const std::string room = include.included.substr(0, include.included.find('/'));
  return room != include.included && placeOf(room) < placeOf("") ? include.included : "";
}

/// Headers of this package, of the standard library and of the libraries that a room may use.
bool isAllowedWithoutRos(const Include& include) {
  if (!ownHeader(include).empty()) return true;
  if (include.generated) return false;
  if (startsWithOneOf(include.included, kCoreLibraries)) return true;
  if (include.included == "httplib.h") return include.file.rfind("live/http/", 0) == 0;
  if (include.included.find('/') == std::string::npos) return include.included != "ros.h";
  return layerOf(include.file) >= placeOf("io") && startsWithOneOf(include.included, kIoLibraries);
}

TEST(Layers, OnlyTheRosLayerIncludesRosOrOtherForeignHeaders) {
  const std::vector<Include> includes = allIncludes();
  EXPECT_GT(includes.size(), 300u) << "the sources were not found";
  for (const Include& include : includes) {
    const int layer = layerOf(include.file);
    if (layer == placeOf("ros") || layer == placeOf("nodes")) continue;
    EXPECT_TRUE(isAllowedWithoutRos(include)) << include.file << " includes " << include.included;
  }
}

TEST(Layers, NothingIncludesAHigherRoom) {
  for (const Include& include : allIncludes()) {
    const std::string own = ownHeader(include);
    if (own.empty()) continue;
    EXPECT_LE(layerOf(own), layerOf(include.file))
        << include.file << " includes " << include.included;
  }
}

TEST(Layers, AreTheFoldersOfTheSources) {
  for (const auto& entry : fs::directory_iterator(fs::path(PROJECT_FOLDER) / "src"))
    EXPECT_LT(placeOf(entry.path().filename().string()), placeOf("")) << entry.path();
}

TEST(Layers, PublicHeadersIncludeNoPrivateOnes) {
  for (const Include& include : includesBelow(fs::path(PROJECT_FOLDER) / "include" / kPackage)) {
    const std::string own = ownHeader(include);
    EXPECT_TRUE(own.empty() || own != include.included)
        << include.file << " includes " << include.included << ", which is not installed";
  }
}

/// What the search for causes must know of an effect, the effect declares (Trait).
TEST(Layers, TheSearchForCausesKnowsNoEffectByItsName) {
  static const std::regex name(R"re("(?:act|plant|sens|noise|exp)_\w+")re");
  int files = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(PROJECT_FOLDER) / "src" / "explanation")) {
    std::ifstream in(entry.path());
    ++files;
    for (std::string line; std::getline(in, line);) {
      const std::string code = line.substr(0, line.find("//"));
      EXPECT_FALSE(std::regex_search(code, name)) << entry.path() << ": " << line;
    }
  }
  EXPECT_GT(files, 40);
}

/// Two types of one name in two libraries are linked as one: what follows is memory destroyed, and
/// no message.
TEST(Layers, NoTypeNameIsUsedTwice) {
  static const std::regex definition(
      R"(^(?:struct|class|enum class) ([A-Z]\w*)(?: final)?(?: :.*)? \{)");
  std::map<std::string, std::string> defined;
  for (const char* folder : {"include", "src"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(PROJECT_FOLDER) / folder)) {
      if (entry.path().extension() != ".h") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        std::smatch match;
        if (!std::regex_search(line, match, definition)) continue;
        const auto [other, is_new] = defined.emplace(match[1], entry.path().string());
        EXPECT_TRUE(is_new || other->second == entry.path().string())
            << match[1] << " is defined in " << other->second << " and in " << entry.path();
      }
    }
  }
  EXPECT_GT(defined.size(), 200u);
}

}  // namespace
}  // namespace uncertainty_identification
