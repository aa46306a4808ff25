#include "io/untrusted_yaml.h"

#include <yaml-cpp/eventhandler.h>

#include <sstream>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kLongest = 1 << 16;  // [bytes]
constexpr int kDeepest = 20;

/// Looks through a text before anything is made of it.
class Inspection : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {
    throw ConfigurationError("configuration: aliases (*name) are refused; write the value out");
  }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    descend();
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    descend();
  }
  void OnMapEnd() override { --depth_; }

 private:
  void descend() {
    if (++depth_ > kDeepest)
      throw ConfigurationError("configuration: nested more than " + std::to_string(kDeepest) +
                               " deep; no key needs that");
  }

  int depth_ = 0;
};

}  // namespace

YAML::Node loadUntrustedYaml(const std::string& text) {
  if (text.size() > kLongest)
    throw ConfigurationError("configuration: found " + std::to_string(text.size()) +
                             " bytes; at most " + std::to_string(kLongest) + " are allowed");
  try {
    std::istringstream stream(text);
    Inspection inspection;
    YAML::Parser(stream).HandleNextDocument(inspection);
    return YAML::Load(text);
  } catch (const YAML::Exception& error) {
    throw ConfigurationError(std::string("configuration is no YAML: ") + error.what());
  }
}

}  // namespace uncertainty_identification
