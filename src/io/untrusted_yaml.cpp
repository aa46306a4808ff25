#include "io/untrusted_yaml.h"

#include <yaml-cpp/eventhandler.h>

#include <sstream>

#include "io/read_file.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kLongestRequest = 1 << 16;  // [bytes]
constexpr int kDeepest = 20;

/// Goes through a text without building a document, and throws YAML::Exception at the first place
/// that must not be built.
class Inspection : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    throw YAML::Exception(mark, "aliases (*name) are refused; write the value out");
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    descend(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    descend(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void descend(const YAML::Mark& mark) {
    if (++depth_ > kDeepest) {
      throw YAML::Exception(
          mark, "nested more than " + std::to_string(kDeepest) + " deep; no key needs that");
    }
  }

  int depth_ = 0;
};

/// The document; `source` starts the message of every ConfigurationError.
YAML::Node parseText(const std::string& text, const std::string& source) {
  const auto refuse = [&source](const YAML::Exception& error, const char* what) {
    return ConfigurationError(source + ", line " + std::to_string(error.mark.line + 1) + what +
                              error.msg);
  };
  try {
    std::istringstream stream(text);
    Inspection inspection;
    YAML::Parser(stream).HandleNextDocument(inspection);
    return YAML::Load(text);
  } catch (const YAML::ParserException& error) {
    throw refuse(error, ": not YAML: ");
  } catch (const YAML::Exception& error) {
    throw refuse(error, ": ");
  }
}

}  // namespace

YAML::Node loadUntrustedYaml(const std::string& text) {
  if (text.size() > kLongestRequest)
    throw ConfigurationError("configuration: found " + std::to_string(text.size()) +
                             " bytes; at most " + std::to_string(kLongestRequest) + " are allowed");
  return parseText(text, "configuration");
}

YAML::Node loadYaml(const std::string& path) {
  const YAML::Node node = parseText(readFile(path), path);
  if (node.IsNull())
    throw ConfigurationError(path + ": the file holds no keys; write {} to take every default");
  return node;
}

}  // namespace uncertainty_identification
