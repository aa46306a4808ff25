#include "io/untrusted_yaml.h"

#include <gtest/gtest.h>

#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

std::string refusal(const std::string& text) {
  return messageOf<ConfigurationError>([&] { loadUntrustedYaml(text); });
}

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

TEST(UntrustedYaml, ReadsWhatConfigurationsAreMadeOf) {
  EXPECT_EQ(loadUntrustedYaml("{a: {b: [[1, 2], [3]]}}")["a"]["b"][1][0].as<int>(), 3);
  EXPECT_EQ(loadUntrustedYaml("a:\n  b: text\n")["a"]["b"].as<std::string>(), "text");
  EXPECT_TRUE(loadUntrustedYaml("").IsNull());
}

TEST(UntrustedYaml, RefusesWhatWouldOverflowTheStack) {
  for (const std::string open : {"[", "{a: ", "- ", "? "})
    EXPECT_NE(refusal(repeated(open, 20000 / static_cast<int>(open.size()))), "") << open;
  EXPECT_NE(refusal(repeated("[", 21) + repeated("]", 21)).find("nested more than 20"),
            std::string::npos);
  EXPECT_NO_THROW(loadUntrustedYaml(repeated("[", 20) + repeated("]", 20)));
}

TEST(UntrustedYaml, RefusesAliases) {
  EXPECT_NE(refusal("{a: &a [1, 2], b: [*a, *a]}").find("aliases"), std::string::npos);
  EXPECT_NE(refusal("&a [*a, *a]").find("line 1: aliases"), std::string::npos);
}

TEST(UntrustedYaml, RefusesLongTexts) {
  EXPECT_NE(refusal(repeated("# long\n", 10000)).find("70000 bytes"), std::string::npos);
}

TEST(UntrustedYaml, SaysThatATextIsNoYaml) {
  EXPECT_NE(refusal("{unclosed").find("configuration, line 1: not YAML"), std::string::npos);
  EXPECT_NE(refusal(std::string("\0\xff\xfe", 3) + "[").size(), 0U);
}

}  // namespace
}  // namespace uncertainty_identification
