#include "io/csv_stamp.h"

#include <gtest/gtest.h>

#include <string>

namespace uncertainty_identification {
namespace {

std::optional<CsvStamp> parsed(const std::string& text) {
  return parseStamp(trimmedCell(text.data(), text.data() + text.size()));
}

/// Date, seconds since midnight and offset as one text.
std::string shown(const std::string& text) {
  const auto stamp = parsed(text);
  if (!stamp) return "none";
  char buffer[96];
  const int zone = stamp->zone_minutes.value_or(-9999);
  std::snprintf(buffer, sizeof buffer, "%04d-%02d-%02d %.9f %s", stamp->year, stamp->month,
                stamp->day, static_cast<double>(stamp->nanoseconds) * 1e-9,
                zone == -9999 ? "-" : std::to_string(zone).c_str());
  return buffer;
}

TEST(CsvStamp, DatesWithTheYearFirst) {
  for (const char* text :
       {"2024-05-01T12:00:00.250", "2024-05-01 12:00:00.25", "2024-05-01 12:00:00,250",
        "2024/05/01 12:00:00.250", "2024-5-1 12:00:00.250000000", "2024-05-01, 12:00:00.250"})
    EXPECT_EQ(shown(text), "2024-05-01 43200.250000000 -") << text;
  EXPECT_EQ(shown("2024-05-01"), "2024-05-01 0.000000000 -");
  EXPECT_EQ(shown("2024-05-01 12:00"), "2024-05-01 43200.000000000 -");
  EXPECT_EQ(shown("2024-05-01T12:00:00.123456789012Z"), "2024-05-01 43200.123456789 0");
  EXPECT_EQ(shown("2024-05-01 12:00:00 UTC"), "2024-05-01 43200.000000000 0");
  EXPECT_EQ(shown("2024-05-01T12:00:00+02:00"), "2024-05-01 43200.000000000 120");
  EXPECT_EQ(shown("2024-05-01T12:00:00-0330"), "2024-05-01 43200.000000000 -210");
  EXPECT_EQ(shown("2024-05-01T12:00:00+01"), "2024-05-01 43200.000000000 60");
  EXPECT_EQ(parsed("2024-05-01")->order, DateOrder::stated);
}

TEST(CsvStamp, DatesWithTheYearLast) {
  EXPECT_EQ(shown("31.05.2024 12:00:00,5"), "2024-05-31 43200.500000000 -");
  EXPECT_EQ(shown("1.5.24 12:00"), "2024-05-01 43200.000000000 -");
  EXPECT_EQ(shown("01-May-2024 12:00:00"), "2024-05-01 43200.000000000 -");
  EXPECT_EQ(shown("5/31/2024 1:02:03 PM"), "2024-05-31 46923.000000000 -");
  EXPECT_EQ(shown("31/05/2024 12:00:00 AM"), "2024-05-31 0.000000000 -");
  EXPECT_EQ(parsed("1.5.2024")->order, DateOrder::stated);
  EXPECT_EQ(parsed("5/31/2024")->order, DateOrder::month_first);
  EXPECT_EQ(parsed("31-05-2024")->order, DateOrder::day_first);
  EXPECT_EQ(parsed("05/06/2024")->order, DateOrder::open);
}

TEST(CsvStamp, TimesOfDay) {
  EXPECT_EQ(shown("12:00:00.5"), "0000-00-00 43200.500000000 -");
  EXPECT_EQ(shown("9:05:07"), "0000-00-00 32707.000000000 -");
  EXPECT_EQ(shown("12:34.5"), "0000-00-00 754.500000000 -");
  EXPECT_EQ(shown("12:30 PM"), "0000-00-00 45000.000000000 -");
  EXPECT_FALSE(parsed("12:30 PM")->is_open);
  EXPECT_TRUE(parsed("12:30")->is_open);
}

TEST(CsvStamp, OtherTextsAreNone) {
  for (const char* text : {"",
                           "1",
                           "12:",
                           "1.5",
                           "12.5.7",
                           "24:00:00",
                           "12:60:00",
                           "12:00:61",
                           "12:00:00.",
                           "12:00:00 h",
                           "2024-13-01",
                           "2024-02-30",
                           "2023-02-29",
                           "32/01/2024",
                           "13/13/2024",
                           "05/06/24",
                           "2024-05",
                           "2024-05-01T",
                           "2024-05-01 noon",
                           "2024-05-01T12:00:00+2",
                           "2024-05-01T12:00:00+25:00",
                           "192.168.1.1",
                           "1.2.3",
                           "01-Foo-2024",
                           "2024-05-01x12:00:00",
                           "seconds since start"})
    EXPECT_EQ(shown(text), "none") << text;
}

TEST(CsvStamp, CountsDays) {
  EXPECT_EQ(daysSince1970(1970, 1, 1), 0);
  EXPECT_EQ(daysSince1970(1969, 12, 31), -1);
  EXPECT_EQ(daysSince1970(2000, 2, 29), 11016);
  EXPECT_EQ(daysSince1970(2024, 5, 1), 19844);
  EXPECT_EQ(daysSince1970(2100, 3, 1) - daysSince1970(2100, 2, 28), 1);
}

}  // namespace
}  // namespace uncertainty_identification
