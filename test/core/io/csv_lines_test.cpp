#include "io/csv_lines.h"

#include <gtest/gtest.h>

#include <fstream>

#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

class CsvLinesTest : public testing::Test {
 protected:
  CsvLines linesOf(const std::string& content) {
    std::ofstream(folder_ / "lines.csv", std::ios::binary) << content;
    return CsvLines(folder_ / "lines.csv");
  }

  std::vector<std::string> all(const std::string& content, std::size_t looked_at = 0) {
    CsvLines lines = linesOf(content);
    lines.first(looked_at);
    std::vector<std::string> found;
    while (lines.next()) {
      found.emplace_back(lines.begin(), lines.end());
      EXPECT_EQ(lines.number(), static_cast<long>(found.size()));
      EXPECT_TRUE(*lines.end() == '\n' || *lines.end() == '\0');
    }
    return found;
  }

  TemporaryFolder folder_;
};

using Lines = std::vector<std::string>;

TEST_F(CsvLinesTest, GivesEveryLineOnceWhateverWasLookedAtBefore) {
  for (const std::size_t looked_at : {0, 1, 2, 3, 4, 100}) {
    EXPECT_EQ(all("a\n\nb\r\nlast", looked_at), (Lines{"a", "", "b\r", "last"}));
    EXPECT_EQ(all("a\nb\n", looked_at), (Lines{"a", "b"}));
    EXPECT_EQ(all("", looked_at), Lines{});
    EXPECT_EQ(all("\n", looked_at), Lines{""});
  }
}

TEST_F(CsvLinesTest, LinesThatSpanBlocksAreWhole) {
  Lines written;
  std::string content;
  for (std::size_t length : {1, 262143, 262144, 5, 1000000, 0, 700001, 3}) {
    written.emplace_back(length, static_cast<char>('a' + written.size()));
    content += written.back() + "\n";
  }
  EXPECT_EQ(all(content), written);
  EXPECT_EQ(all(content, 3), written);
}

TEST_F(CsvLinesTest, AByteOrderMarkIsNoPartOfTheFirstLine) {
  EXPECT_EQ(all("\xEF\xBB\xBFt,u\n1,2\n", 1), (Lines{"t,u", "1,2"}));
}

TEST_F(CsvLinesTest, WhatIsNoTextIsRefused) {
  const auto complaint = [&](const std::string& content) {
    return messageOf<FileError>([&] { linesOf(content).first(5); });
  };
  EXPECT_NE(complaint(std::string("t\0,\0u\0", 6)).find("save it as CSV in UTF-8"),
            std::string::npos);
  EXPECT_NE(complaint("t,u\r1,2\r").find("LF or CR LF"), std::string::npos);
  EXPECT_EQ(complaint("t,u\r\n1,2\r\n"), "no exception");
}

}  // namespace
}  // namespace uncertainty_identification
