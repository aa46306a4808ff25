#include <gtest/gtest.h>

#include <fstream>

#include "io/csv_table.h"
#include "support/error_message.h"
#include "support/mentions.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/csv.h"

namespace uncertainty_identification {
namespace {

class CsvDatesOfFile : public testing::Test {
 protected:
  std::string write(const std::string& content) const {
    std::ofstream(folder_ / "log.csv", std::ios::binary) << content;
    return folder_ / "log.csv";
  }

  CsvFile file(const std::string& content) const { return parseCsv(write(content), {}); }

  /// Stamps of a file with these cells in its column t.
  std::vector<double> stamps(const std::vector<std::string>& cells) const {
    const CsvFile read = file(table(cells));
    EXPECT_EQ(read.tables.front().problem, "");
    return read.tables.front().t;
  }

  std::string problem(const std::vector<std::string>& cells) const {
    return file(table(cells)).tables.front().problem;
  }

  static std::string table(const std::vector<std::string>& cells) {
    std::string content = "t;u;y\n";
    for (const std::string& cell : cells) content += cell + ";1;2\n";
    return content;
  }

  const TemporaryFolder folder_;
};

using Stamps = std::vector<double>;

TEST_F(CsvDatesOfFile, KeepNanosecondsOverDays) {
  EXPECT_EQ(stamps({"2024-05-01T23:59:59.999999999", "2024-05-02T00:00:00",
                    "2024-05-11T23:59:59.999999998"}),
            (Stamps{0, 1e-9, 863999.999999999}));
  const CsvFile read = file(table({"2024-05-01T12:00:00.250Z", "2024-05-01T14:00:01+02:00"}));
  EXPECT_EQ(read.tables.front().t, (Stamps{0, 0.75}));
  EXPECT_EQ(read.tables.front().start, 1714564800.25);
}

TEST_F(CsvDatesOfFile, ANumberAboveTwelveShowsTheOrder) {
  EXPECT_EQ(stamps({"05/01/2024", "05/02/2024", "05/13/2024"}), (Stamps{0, 86400, 12 * 86400}));
  EXPECT_EQ(stamps({"01/05/2024", "02/05/2024", "13/05/2024"}), (Stamps{0, 86400, 12 * 86400}));
  const CsvFile read = file(table({"01/05/2024", "13/05/2024"}));
  EXPECT_TRUE(test::anyMentions(read.remarks, "the day first as in 13/05/2024 in line 3"));
}

TEST_F(CsvDatesOfFile, OneDayNeedsNoOrder) {
  const CsvFile read = file(table({"05/06/2024 00:00:01", "05/06/2024 00:00:01.5"}));
  EXPECT_EQ(read.tables.front().t, (Stamps{0, 0.5}));
  EXPECT_TRUE(test::anyMentions(read.remarks, "only the time of day is used"));
}

TEST_F(CsvDatesOfFile, TimesOfDayPassMidnight) {
  EXPECT_EQ(stamps({"23:59:59.5", "00:00:00.0", "00:00:00.5"}), (Stamps{0, 0.5, 1}));
  EXPECT_TRUE(test::mentions(problem({"12:00:01", "12:00:00"}), "goes back from the one before"));
}

TEST_F(CsvDatesOfFile, EachExperimentCountsFromItsFirstStamp) {
  const CsvFile read =
      file("experiment,t,u,y\na,10:00:00,1,2\nb,09:00:00,1,2\na,10:00:00.5,1,2\nb,09:00:02,1,2\n");
  EXPECT_EQ(read.tables[0].t, (Stamps{0, 0.5}));
  EXPECT_EQ(read.tables[1].t, (Stamps{0, 2}));
  EXPECT_EQ(read.tables[1].start, 9 * 3600);
}

TEST_F(CsvDatesOfFile, ExperimentsKnowWhenTheyBegan) {
  const LoadedData data = readCsv(
      write(table({"2024-05-01 12:00:00", "2024-05-01 12:00:01", "2024-05-01 12:00:02"})), {});
  ASSERT_EQ(data.experiments.size(), 1u);
  EXPECT_EQ(data.experiments.front().start_time, 1714564800);
}

TEST_F(CsvDatesOfFile, RefusalsNameLineColumnAndRemedy) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> refused = {
      {{"05/06/2024", "05/07/2024"}, "line 3, column t: found '05/07/2024', whose day and month"},
      {{"05/06/2024", "05/07/2024"}, "write the year first, as in 2024-05-31"},
      {{"05/13/2024", "13/05/2024"}, "but 05/13/2024 in line 2 has day and month in the other"},
      {{"12:30", "12:31"}, "line 2, column t: found '12:30', which could be hours and minutes"},
      {{"12:30:00", "2024-05-01 12:30:01"}, "the first stamp of the experiment has no date"},
      {{"12:30:00Z", "12:30:01"}, "the first stamp of the experiment has an offset from UTC"},
      {{"12:30:00", "12:30:01", "noon"}, "line 4, column t: found 'noon' in a column of dates"},
      {{"2024-05-01", "2024-05-01"}, "line 3, column t: the stamp 2024-05-01 repeats"},
  };
  for (const auto& [cells, remedy] : refused)
    EXPECT_TRUE(test::mentions(problem(cells), remedy)) << problem(cells);
}

TEST_F(CsvDatesOfFile, TheirColumnIsFoundByWhatItHolds) {
  const CsvFile read = file("Zeit;u;y\n12:00:00,5;1;2\n12:00:01,0;1;2\n");
  EXPECT_EQ(read.time_name, "Zeit");
  EXPECT_EQ(read.tables.front().t, (Stamps{0, 0.5}));
  EXPECT_TRUE(test::anyMentions(read.remarks, "the time is 'Zeit', read as times of day"));
}

TEST_F(CsvDatesOfFile, AUnitIsRefused) {
  Configuration configuration;
  configuration.time.unit = TimeUnit::milliseconds;
  const std::string path = write(table({"12:00:00", "12:00:01"}));
  const std::string message = messageOf<ConfigurationError>([&] { parseCsv(path, configuration); });
  EXPECT_TRUE(test::mentions(message, "leave time.unit out")) << message;
}

}  // namespace
}  // namespace uncertainty_identification
