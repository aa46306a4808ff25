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

/// What the layers below input and output may use besides the standard library and this package.
const std::vector<std::string> kCoreLibraries{"Eigen/", "unsupported/Eigen/", "boost/math/",
                                              "sys/"};
const std::vector<std::string> kIoLibraries{"yaml-cpp/", "nlohmann/", "boost/program_options"};

/// Layers from the lowest; a file may include what is in its own or a lower one.
const std::map<std::string, int> kLayers{
    {"data", 1},       {"model", 2},  {"effects", 3},   {"estimation", 4},  {"residual_tests", 5},
    {"simulation", 4}, {"bounds", 5}, {"detection", 6}, {"explanation", 8}, {"io", 9},
    {"ros", 10},       {"nodes", 11}, {"tools", 12}};
constexpr int kIdentifier = 7;
constexpr int kSharedVocabulary = 0;  // configuration.h, errors.h, ...

/// The layer of a path relative to include/<package>/ or src/.
int layerOf(const std::string& path) {
  if (path.rfind("identifi", 0) == 0) return kIdentifier;
  const auto layer = kLayers.find(path.substr(0, path.find('/')));
  return layer == kLayers.end() ? kSharedVocabulary : layer->second;
}

/// The highest layer that a file of this layer may include: the configuration speaks of mixtures.
int highestFor(int layer) { return layer == kSharedVocabulary ? kLayers.at("model") : layer; }

struct Include {
  std::string file;      ///< relative to its root
  std::string included;  ///< as written between <> or ""
  bool generated;        ///< <package/...> in angle brackets: a generated message
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
      found.push_back(
          {fs::relative(entry.path(), root).string(), match[2], ours && match[1] == "<"});
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

/// Headers of this package, of the standard library and of the libraries that a layer may use.
bool isAllowedWithoutRos(const Include& include) {
  if (include.included.rfind(kPackage + "/", 0) == 0) return !include.generated;
  if (include.included.find('/') == std::string::npos) return include.included != "ros.h";
  const int layer = layerOf(include.included);  // of a header beside the sources
  if (layer != kSharedVocabulary && layer < kLayers.at("ros")) return true;
  const bool io = layerOf(include.file) >= kLayers.at("io");
  return startsWithOneOf(include.included, kCoreLibraries) ||
         (io && startsWithOneOf(include.included, kIoLibraries));
}

TEST(Layers, OnlyTheRosLayerIncludesRosOrOtherForeignHeaders) {
  const std::vector<Include> includes = allIncludes();
  EXPECT_GT(includes.size(), 300u) << "the sources were not found";
  for (const Include& include : includes) {
    const int layer = layerOf(include.file);
    if (layer == kLayers.at("ros") || layer == kLayers.at("nodes")) continue;
    EXPECT_TRUE(isAllowedWithoutRos(include)) << include.file << " includes " << include.included;
  }
}

TEST(Layers, NothingIncludesAHigherLayer) {
  const std::string prefix = kPackage + "/";
  for (const Include& include : allIncludes()) {
    if (include.generated) continue;
    const bool is_public = include.included.rfind(prefix, 0) == 0;
    const std::string path = include.included.substr(is_public ? prefix.size() : 0);
    EXPECT_LE(layerOf(path), highestFor(layerOf(include.file)))
        << include.file << " includes " << include.included;
  }
}

}  // namespace
}  // namespace uncertainty_identification
