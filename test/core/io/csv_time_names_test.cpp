#include "io/csv_time_names.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

/// The unit that the name tells; "?" if it tells none, "no" if it is no name of the time.
std::string unitOf(const std::string& name) {
  const auto found = timeName(name);
  if (!found) return "no";
  return found->unit.empty() ? "?" : found->unit;
}

TEST(CsvTimeNames, WellKnownNamesTellTheirUnitAtTheEnd) {
  for (const char* name : {"t", "time", "Time", "TIMESTAMP", "__time", "stamp", "elapsed_time",
                           "sampling_time", "sim_time"})
    EXPECT_EQ(unitOf(name), "?") << name;
  EXPECT_EQ(unitOf("time_ms"), "ms");
  EXPECT_EQ(unitOf("Timestamp_US"), "us");
  EXPECT_EQ(unitOf("t_s"), "s");
  EXPECT_EQ(unitOf("elapsed_time_ns"), "ns");
  EXPECT_EQ(unitOf("Time [ms]"), "ms");
  EXPECT_EQ(unitOf("time_h"), "h");
  EXPECT_EQ(unitOf("t [min]"), "min");
  EXPECT_EQ(unitOf("time(s)"), "s");
  EXPECT_EQ(unitOf("%time"), "ns");
  EXPECT_EQ(unitOf("rosbagTimestamp"), "ns");
  EXPECT_EQ(unitOf("seconds"), "s");
  EXPECT_EQ(unitOf("millis"), "ms");
  EXPECT_EQ(unitOf("Second"), "s");
  EXPECT_EQ(unitOf("Tiempo (s)"), "s");
}

TEST(CsvTimeNames, OtherNamesAreNotGuessed) {
  for (const char* name :
       {"T", "T [K]", "u", "", "temp", "torque_ms", "time_of_day", "runtime", "/odom/header/stamp",
        "T_h", "t_min", "lifetime", "time_", "_ms", "ms", "times"})
    EXPECT_EQ(unitOf(name), "no") << name;
}

TEST(CsvTimeNames, UnitsInBracketsAreNoPartOfTheName) {
  const auto parts = [](const std::string& name) {
    const CsvName split = splitUnit(name);
    return split.base + "|" + split.unit;
  };
  EXPECT_EQ(parts("speed [rad/s]"), "speed|rad/s");
  EXPECT_EQ(parts("speed(rad/s)"), "speed|rad/s");
  EXPECT_EQ(parts("a [b] c"), "a [b] c|");
  EXPECT_EQ(parts("f(x) [m]"), "f(x)|m");
  EXPECT_EQ(parts("[ms]"), "|ms");
  EXPECT_EQ(parts("x]"), "x]|");
  EXPECT_EQ(parts(""), "|");
}

TEST(CsvTimeNames, UnitsOfTimeInAnyCase) {
  EXPECT_EQ(perSecond("s"), 1);
  EXPECT_EQ(perSecond("Sec"), 1);
  EXPECT_EQ(perSecond("ms"), 1e3);
  EXPECT_EQ(perSecond("us"), 1e6);
  EXPECT_EQ(perSecond("\xC2\xB5s"), 1e6);
  EXPECT_EQ(perSecond("nanoseconds"), 1e9);
  EXPECT_EQ(perSecond("min"), 1.0 / 60);
  EXPECT_EQ(perSecond("h"), 1.0 / 3600);
  EXPECT_EQ(perSecond("days"), 1.0 / 86400);
  for (const char* unit : {"", "V", "m", "rad/s"}) EXPECT_FALSE(perSecond(unit)) << unit;
}

}  // namespace
}  // namespace uncertainty_identification
