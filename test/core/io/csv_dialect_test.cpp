#include "io/csv_dialect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

namespace uncertainty_identification {
namespace {

/// The text as one cell. It must outlive the cell.
CsvCell cellOf(const std::string& text) {
  return trimmedCell(text.data(), text.data() + text.size());
}

double numberIn(const std::string& text, CsvDialect dialect = CsvDialect(',')) {
  double value = std::nan("");
  return dialect.number(cellOf(text), value) ? value : std::nan("");
}

std::vector<std::string> cells(const CsvDialect& dialect, const std::string& line) {
  std::vector<std::string> texts;
  for (const CsvCell& cell : dialect.split(line)) texts.push_back(cell.str());
  return texts;
}

using Cells = std::vector<std::string>;

/// Whether a number is read as the double that is nearest to it, as by the standard library.
void expectExact(const std::string& text) {
  const double expected = std::strtod(text.c_str(), nullptr), found = numberIn(text);
  EXPECT_EQ(std::memcmp(&expected, &found, sizeof found), 0) << text << " is read as " << found;
}

TEST(CsvDialect, NumbersAreExactToTheLastBit) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> exponent(-20, 20);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::pow(10.0, exponent(engine)) * (i % 2 == 0 ? 1 : -1);
    char text[64];
    const char* const formats[] = {"%.17g", "%.15g", "%.8g", "%.6f", "%.3f", "%.0f", "%+.4e"};
    std::snprintf(text, sizeof text, formats[i % 7], value);
    expectExact(text);
  }
  for (const char* text :
       {"-0", "+0", "0.000000000000001", "999999999999999", "1234567890123456", "-123456789.123456",
        "9007199254740993", "1e400", "-1e-400", "inf", "-nan", "0x1p-3", "5.", ".5", "-.25"})
    expectExact(text);
}

TEST(CsvDialect, StatesOfSwitchesAreOneAndZero) {
  for (const char* text : {"True", "true", "ON", "on"}) EXPECT_EQ(numberIn(text), 1) << text;
  for (const char* text : {"False", "FALSE", "off"}) EXPECT_EQ(numberIn(text), 0) << text;
  EXPECT_FALSE(looksNumeric(cellOf("on"))) << "may well be the name of a column";
}

TEST(CsvDialect, OtherTextsAreNoNumbers) {
  for (const char* text :
       {"",   "-",   "+",     ".",     "-.",  "1.2.3", "1-2",  "--1",   "1 2", "1e",
        "e5", "1,5", "12:30", "1_000", "1;2", "abc",   "1.5V", "truth", "o",   "offs"})
    EXPECT_TRUE(std::isnan(numberIn(text))) << text;
}

TEST(CsvDialect, TheFirstFractionDecidesOnTheDecimalPoint) {
  CsvDialect comma(';'), point(';'), open(';');
  double value = 0;
  EXPECT_TRUE(comma.number(cellOf("7"), value));
  EXPECT_FALSE(comma.hasDecimalComma());
  EXPECT_TRUE(comma.number(cellOf("-1,25"), value));
  EXPECT_EQ(value, -1.25);
  EXPECT_TRUE(comma.hasDecimalComma());
  EXPECT_TRUE(comma.number(cellOf("1,2345678901234567e-3"), value));
  EXPECT_EQ(value, 1.2345678901234567e-3);
  EXPECT_FALSE(comma.number(cellOf("1.25"), value));
  EXPECT_FALSE(comma.number(cellOf("1.2345678901234567"), value));
  EXPECT_TRUE(point.number(cellOf("1.25"), value));
  EXPECT_FALSE(point.number(cellOf("1,25"), value));
  EXPECT_FALSE(point.hasDecimalComma());
  EXPECT_FALSE(open.number(cellOf("a,b"), value));
  EXPECT_TRUE(open.number(cellOf("1.5"), value));  // what is no number decides nothing
}

TEST(CsvDialect, ClearNumbersShowWhatSeparatesThousands) {
  CsvDialect american(','), german(';'), swiss(';'), french('\t');
  const auto read = [](CsvDialect& dialect, const std::string& text) {
    double value = std::nan("");
    return dialect.number(cellOf(text), value) ? value : std::nan("");
  };
  EXPECT_TRUE(std::isnan(read(american, "\"1,234\"")));  // or 1.234
  EXPECT_EQ(read(american, "\"1,234.5\""), 1234.5);
  EXPECT_EQ(read(american, "\"-1,234\""), -1234);
  EXPECT_TRUE(std::isnan(read(american, "\"1,23\"")));
  EXPECT_EQ(read(german, "1.234.567"), 1234567);
  EXPECT_EQ(read(german, "1.234"), 1234);
  EXPECT_EQ(read(german, "0,125"), 0.125);
  EXPECT_TRUE(std::isnan(read(german, "0.125")));
  EXPECT_TRUE(std::isnan(read(german, "1,234.5")));
  EXPECT_EQ(read(swiss, "+12'345.5"), 12345.5);
  EXPECT_EQ(read(french,
                 "12\xE2\x80\xAF"
                 "345\xC2\xA0"
                 "678,5"),
            12345678.5);
  EXPECT_EQ(read(french, "1 234"), 1234);
  EXPECT_EQ(french.thousands(), ' ');
}

TEST(CsvDialect, NumbersThatCouldBeReadTwiceAreExplained) {
  const CsvDialect comma(','), semicolon(';');
  EXPECT_NE(comma.remedyFor(cellOf("\"1,234\"")).find("without separators of thousands"),
            std::string::npos);
  EXPECT_NE(comma.remedyFor(cellOf("\"1,5\"")).find("need another separator"), std::string::npos);
  EXPECT_EQ(comma.remedyFor(cellOf("abc")), "");
  EXPECT_EQ(semicolon.remedyFor(cellOf("1,5V")), "");
}

TEST(CsvDialect, LinesAreSplitOutsideQuotes) {
  EXPECT_EQ(cells(CsvDialect(','), " a ,\"b, c\",,\"d \"\"e\"\"\"\r"),
            (Cells{"a", "b, c", "", "d \"e\""}));
  EXPECT_EQ(cells(CsvDialect(';'), "a,b;c d;"), (Cells{"a,b", "c d", ""}));
  EXPECT_EQ(cells(CsvDialect('\t'), "\ta b\t\t1"), (Cells{"", "a b", "", "1"}));
  EXPECT_EQ(cells(CsvDialect(' '), "  a \t\"b c\"   1  \r"), (Cells{"a", "b c", "1"}));
  EXPECT_EQ(cells(CsvDialect(','), ""), Cells{""});
}

TEST(CsvDialect, TheSeparatorIsTheOneThatMostRowsAgreeWith) {
  const auto found = [](const std::string& header, const std::vector<std::string>& rows) {
    return findDialect(header, rows).separator();
  };
  EXPECT_EQ(found("t,u,y", {"0,1,2", "1,2,3"}), ',');
  EXPECT_EQ(found("t;u, left;y", {"0;1,5;2", "1;2;3"}), ';');
  EXPECT_EQ(found("t [s],u [V],y [m]", {"0, 1, 2", "1, 2, 3"}), ',');
  EXPECT_EQ(found("time s\tu V\ty m", {"0\t1\t2"}), '\t');
  EXPECT_EQ(found("t u y", {"0 1,5 2", "1 2,5 3"}), ' ');
  EXPECT_EQ(found("t,u,y", {"0,1", "1,2,3", "2,3,4"}), ',');  // a bad row does not mislead
  EXPECT_EQ(found("t;u;y", {}), ';');
  EXPECT_EQ(found("only", {"1", "2"}), ',');
}

TEST(CsvDialect, NumbersWithEitherPointLookNumeric) {
  for (const char* text : {"1", "1.5", "1,5", "-2e3", "nan", "1.000,5", "1 000", "1'000.5"})
    EXPECT_TRUE(looksNumeric(cellOf(text))) << text;
  for (const char* text : {"", "V", "1.00,5", "12:30", "1,000.000,5", "10 00"})
    EXPECT_FALSE(looksNumeric(cellOf(text))) << text;
}

}  // namespace
}  // namespace uncertainty_identification
