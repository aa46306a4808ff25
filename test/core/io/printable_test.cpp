#include "io/printable.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

TEST(Printable, KeepsTextAndEscapesTheRest) {
  EXPECT_EQ(printable("wheel_speed [rad/s]"), "wheel_speed [rad/s]");
  EXPECT_EQ(printable("\xC2\xB0"
                      "C"),
            "\xC2\xB0"
            "C");
  EXPECT_EQ(printable("\xE2\x82\xAC \xF0\x9F\x98\x80"), "\xE2\x82\xAC \xF0\x9F\x98\x80");
  EXPECT_EQ(printable("a\tb\x1b[31m"), "a\\x09b\\x1B[31m");
  EXPECT_EQ(printable("Temp \xB0"), "Temp \\xB0") << "Latin-1";
  EXPECT_EQ(printable("\xC0\xAF"), "\\xC0\\xAF") << "overlong";
  EXPECT_EQ(printable("\xED\xA0\x80"), "\\xED\\xA0\\x80") << "half of a surrogate pair";
  EXPECT_EQ(printable("\xC2\x85"), "\\xC2\\x85") << "a control character";
  EXPECT_EQ(printable("\xE2\x82"), "\\xE2\\x82") << "cut off";
  EXPECT_TRUE(isPrintable(""));
  EXPECT_FALSE(isPrintable(std::string(1, '\0')));
}

TEST(PrintableText, KeepsLineBreaksAlone) {
  EXPECT_EQ(printableText("a\n\xFF b\r\n"), "a\n\\xFF b\\x0D\n");
  EXPECT_EQ(printableText(""), "");
}

}  // namespace
}  // namespace uncertainty_identification
