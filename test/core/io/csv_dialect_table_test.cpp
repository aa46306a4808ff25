#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>

#include "support/mentions.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/csv.h"

namespace uncertainty_identification {
namespace {

using Configure = std::function<void(Configuration&)>;

/// A file as some program writes it. It holds the samples u = 1.5, -2, 3 and y = 10, 20.25, -0.5 at
/// 0, 0.5 and 1 s, or is refused with a message that holds `remedy`.
struct Dialect {
  std::string content;
  Configure configure = {};
  std::string remedy = {};
};

void PrintTo(const Dialect& dialect, std::ostream* out) { *out << dialect.content; }

Configure columns(const std::string& u, const std::string& y, const std::string& t = "") {
  return [=](Configuration& configuration) {
    configuration.input.column = u;
    configuration.output.column = y;
    configuration.time.column = t;
  };
}

Configure unit(TimeUnit of_time, double sample_time = 0) {
  return [=](Configuration& configuration) {
    configuration.time.unit = of_time;
    configuration.time.sample_time = sample_time;
  };
}

void inDegrees(Configuration& configuration) {
  configuration.input.scale = -0.5;
  configuration.input.offset = 1;
  configuration.output.scale = 0.01;
}

const std::string kRows = "0,1.5,10\n0.5,-2,20.25\n1,3,-0.5\n";
const std::string kSemicolons = "0;1,5;10\n0,5;-2;20,25\n1;3;-0,5\n";
const std::string kMilliseconds = "0;1.5;10\n500;-2;20.25\n1000;3;-0.5\n";
const std::string kTabs = "0\t1.5\t10\n0.5\t-2\t20.25\n1\t3\t-0.5\n";
const std::string kBlanks = "0    1.5  10\n0.5  -2   20.25\n1    3    -0.5\n";

std::vector<Dialect> separators() {
  return {{"t,u,y\n" + kRows},
          {"t;u;y\n" + kSemicolons},
          {"t\tu\ty\n" + kTabs},
          {"t u y\n" + kBlanks},
          {"   t    u    y\n  0.0  1.5 10.0\n  0.5 -2.0 20.25\n  1.0  3.0 -0.5\n"},
          {"t , u , y\n0 , 1.5 , 10\n0.5 , -2 , 20.25\n1 , 3 , -0.5\n"},
          {"t; u; y\n0; 1.5; 10\n0.5; -2; 20.25\n1; 3; -0.5\n"},
          {"sep=;\nt;u;y\n" + kSemicolons},
          {"sep=\t\r\nt\tu\ty\r\n" + kTabs},
          {"t,u,y,\n0,1.5,10,\n0.5,-2,20.25,\n1,3,-0.5,\n"},
          {"t;u;y;\n" + kSemicolons},
          {"t,u,y\n0,1.5,10,\n0.5,-2,20.25,\n1,3,-0.5,\n"},
          {"y;t;u\n10;0;1,5\n20,25;0,5;-2\n-0,5;1;3\n"},
          {"t;u;y\n0,000E+00;1,5E0;1E+1\n5E-1;-2,0;2,025E+1\n1;3;-5,0e-1\n"},
          {"t,u,y\n0,1.500000000000000000,10\n0.5,-2,20.25\n1,3.0e0,-.5\n"},
          {"t,u,y\n0,+1.5,10.\n0.50,-2,20.25\n1,3,-0.5"}};
}

std::vector<Dialect> headers() {
  const Configure drive = columns("motor, left", "speed");
  return {{"\xEF\xBB\xBFt,u,y\r\n0,1.5,10\r\n\r\n0.5,-2,20.25\r\n1,3,-0.5\r\n"},
          {"# by hand\n% remark\n// remark\n\nt,u,y\n" + kRows},
          {"# t,u,y\n" + kRows},
          {"SWV Data Console - port: 0\nt,u,y\n" + kRows},
          {"Motor test 7\n2024-05-06\nt;u;y\n" + kSemicolons},
          {"recorded by hand,,\n" + kRows, columns("column2", "column3")},
          {"% t u y\n" + kBlanks},
          {"# made 2024\n#t;u;y\n" + kSemicolons},
          {"\"t\",\"u\",\"y\"\n\"0\",\"1.5\",\"10\"\n\"0.5\",\"-2\",\"20.25\"\n1,3,-0.5\n"},
          {"\"t\";\"u\";\"y\"\n\"0\";\"1,5\";\"10\"\n\"0,5\";\"-2\";\"20,25\"\n1;3;\"-0,5\"\n"},
          {"t [s],u [V],y [rad/s]\n" + kRows},
          {"t (s);u (V);y (rad/s)\n" + kSemicolons},
          {"t,u,y\ns,V,rad/s\n" + kRows},
          {"t;u;y\n[s];[V];[rad/s]\n" + kSemicolons},
          {"t;u;y\n[ms];[V];[rad/s]\n" + kMilliseconds},
          {"t [ms];u;y\n" + kMilliseconds},
          {"zeit;u;y\nms;V;\n" + kMilliseconds, columns("", "", "zeit")},
          {"t;\"motor, left\";speed\n" + kSemicolons, drive},
          {"t,\"motor, left\",speed [rad/s]\n" + kRows, drive},
          {",t,u,y\n0,0,1.5,10\n1,0.5,-2,20.25\n2,1,3,-0.5\n"},
          {kRows, columns("column2", "column3")},
          {"# a b\n" + kBlanks, columns("column2", "column3")},
          {kSemicolons, columns("column2", "column3", "t")}};
}

std::vector<Dialect> times() {
  const std::string nanoseconds =
      ",u,y\n1000000000,1.5,10\n1500000000,-2,20.25\n2000000000,3,-0.5\n";
  const std::string counted = "n,u,y\n7,1.5,10\n8,-2,20.25\n9,3,-0.5\n";
  const Configure index = unit(TimeUnit::index, 0.5);
  return {{"Time,u,y\n" + kRows},
          {"timestamp,u,y\n" + kRows},
          {"__time,/cmd/data,/odom/v\n" + kRows, columns("/cmd/data", "/odom/v")},
          {"time_ms;motor_voltage;wheel_speed\n" + kMilliseconds,
           columns("motor_voltage", "wheel_speed")},
          {"Time (ms);u;y\n" + kMilliseconds},
          {"t;u;y\n" + kMilliseconds, unit(TimeUnit::milliseconds)},
          {"time_s;u;y\n" + kMilliseconds, unit(TimeUnit::milliseconds)},
          {"time_us,u,y\n0,1.5,10\n500000,-2,20.25\n1000000,3,-0.5\n"},
          {"time_ns" + nanoseconds},
          {"rosbagTimestamp" + nanoseconds},
          {"%time" + nanoseconds},
          {"sample,u,y\n" + kRows, columns("u", "y", "sample")},
          {"u,y\n1.5,10\n-2,20.25\n3,-0.5\n", index},
          {counted, [index](Configuration& c) { index(c), c.time.column = "n"; }},
          {"t,time,u,y\n0,5,1.5,10\n0.5,6,-2,20.25\n1,7,3,-0.5\n"}};
}

/// The rows with these texts as stamps.
std::string stamped(const std::string& header, const std::string& first, const std::string& second,
                    const std::string& third) {
  const char separator = header[header.find_first_of(",;")];
  const std::vector<std::string> values = {"1.5,10", "-2,20.25", "3,-0.5"};
  std::string content = header + "\n";
  std::size_t row = 0;
  for (const std::string& stamp : {first, second, third}) {
    std::string rest = values[row++];
    std::replace(rest.begin(), rest.end(), ',', separator);
    content += stamp + separator + rest + "\n";
  }
  return content;
}

std::vector<Dialect> dates() {
  const std::string header = "t,u,y", day = "2024-05-01 12:00:0";
  return {
      {stamped(header, "2024-05-01T12:00:00.250", "2024-05-01T12:00:00.750",
               "2024-05-01T12:00:01.250")},
      {stamped("timestamp,u,y", day + "0", day + "0.5", day + "1")},
      {stamped("Date/Time;u;y", "01.05.2024 12:00:00,0", "01.05.2024 12:00:00,5",
               "01.05.2024 12:00:01,0")},
      {stamped(header, day + "0Z", day + "0.5Z", "2024-05-01 14:00:01+02:00")},
      {stamped("datetime;u;y", "31/05/2024 23:59:59.5", "01/06/2024 00:00:00.0",
               "01/06/2024 00:00:00.5")},
      {stamped(header, "5/31/2024 11:59:59.5 AM", "5/31/2024 12:00:00.0 PM",
               "5/31/2024 12:00:00.5 PM")},
      {stamped(header, "01-May-2024 23:59:59.5", "02-May-2024 00:00:00", "02-May-2024 00:00:00.5")},
      {stamped(header, "12:00:00.0", "12:00:00.5", "12:00:01.0")},
      {stamped(header, "59:59.0", "59:59.5", "1:00:00.0")},
      {"date,time,u,y\n2024-05-01,23:59:59.5,1.5,10\n2024-05-02,00:00:00,-2,20.25\n"
       "2024-05-02,00:00:00.5,3,-0.5\n"}};
}

std::vector<Dialect> values() {
  return {{"t,mode,u,y\n0,idle,1.5,10\n0.5,run,-2,20.25\n1,run,3,-0.5\n"},
          {"date;t;u;y\n01.02.2024;0;1,5;10\n01.02.2024;0,5;-2;20,25\n01.02.2024;1;3;-0,5\n"},
          {"t,u,y\n0,-1,1000\n0.5,6,2025\n1,-4,-50\n", inDegrees},
          {"t,u,y,temp\n0,1.5,10,NA\n0.5,-2,20.25,null\n1,3,-0.5,5\n"},
          {"run,t,u,y\na,0,1.5,10\na,0.5,-2,20.25\na,1,3,-0.5\n",
           [](Configuration& c) { c.experiment.column = "run"; }}};
}

/// The values are 1,000 times as large as those expected.
std::vector<Dialect> thousands() {
  const Configure small = [](Configuration& configuration) {
    configuration.input.scale = configuration.output.scale = 0.001;
  };
  return {{"t,u,y\n0,\"1,500.0\",\"10,000\"\n0.5,\"-2,000\",\"20,250\"\n1,\"3,000\",-500\n", small},
          {"t,u,y\n0,\"1,500\",\"10,000\"\n0.5,\"-2,000\",\"20,250\"\n1,\"3,000.0\",-500\n", small},
          {"t;u;y\n0;1.500,0;10.000\n0,5;-2.000;20.250\n1;3.000;-500\n", small},
          {"t;u;y\n0;1,500.0;10,000\n0.5;-2,000;20,250\n1;3,000;-500\n", small},
          {"t,u,y\n0,1 500,10 000.0\n0.5,-2 000,20 250\n1,3 000,-500\n", small},
          {"t;u;y\n0;1\xC2\xA0"
           "500;10\xC2\xA0"
           "000,0\n0,5;-2000;20250\n1;3000;-500\n",
           small},
          {"t\tu\ty\n0\t1'500\t10'000\n0.5\t-2'000\t20'250\n1\t3'000\t-500\n", small}};
}

std::vector<Dialect> refused() {
  return {
      {kRows, {}, "there is no header line, and the columns are called 't,column2,column3', "},
      {"3,1,2\n2,2,3\n4,1,1\n", {}, "the columns are called 'column1,column2,column3'"},
      {"time,stamp,u,y\n" + kRows, {}, "the time could be any of 'time,stamp': line 1"},
      {"T,u,y\n" + kRows, {}, "write time: {column: NAME, unit: ms}"},
      {"t,volt,y\n" + kRows, {}, "without u; write input: {column: NAME}"},
      {"t,u,speed\n" + kRows, {}, "without y; write output: {column: NAME}"},
      {"t,volt,speed\n" + kRows, columns("vol", "speed"), "input.column: "},
      {"t,volt,speed\n" + kRows, columns("vol", "speed"), "the nearest name is 'volt'"},
      {"t,volt,speed\n" + kRows, columns("volt", "sped"), "line 1 is 't,volt,speed'"},
      {"t,u,y\n0,0,1,5,10\n0,5,-2,20,25\n", {}, "line 2: found 5 cells under 3 columns"},
      {"t,u,y\n0,0,1,5,10\n0,5,-2,20,25\n", {}, "decimal commas need another separator"},
      {"t;u;y\n0;1,5;10\n0,5;-2;20.25\n", {}, "line 3, column y: found '20.25'"},
      {"t;u;y\n0;1.5;10\n0.5;1.234,5;20\n", {}, "line 2, column u: found '1.5'"},
      {"t;u;y\n0;1,5;10\n0,5;1.234;20\n", {}, "line 3, column u: found '1.234'"},
      {"t;u;y\n0;1,5;10\n0,5;1.234;20\n", {}, "write numbers without separators of thousands"},
      {"t,u,y\n0,1.5,10\n1,\"1,234\",20\n", {}, "line 3, column u: found '1,234'"},
      {"t,u,y\n0,1.5,10\n1,1,234.5,20\n", {}, "commas between thousands need quotes"},
      {"t u y\n0 1.5 10\n1 1 234.5 20\n", {}, "line 3: found 4 cells under 3 columns"},
      {"t,u,y\nseconds since start,V,m\n" + kRows, {}, "line 2, column t: found 'seconds since"},
      {"t,u,y\n12:00,1,2\n12:01,1,2\n", {}, "line 2, column t: found '12:00', which could be"},
      {"t,u,y\n0,1,2\n12:00:01,1,2\n", {}, "line 3, column t: found '12:00:01'; write a number"},
      {"t_ms,u,y\ns,V,m\n" + kRows, {}, "ms by its name and s by the row below it"},
      {"t,u,u,y\n0,1,1,2\n1,2,2,3\n", {}, "no two columns may have the same name"},
      {"\xFF\xFEt", {}, "save it as CSV in UTF-8"},
      {"t,u,y\r0,1,2\r1,2,3\r", {}, "save it with line ends LF or CR LF"},
      {"t,u,y\n0,1,run\n1,2,stop\n", {}, "line 2, column y: found 'run'"},
      {"t,run,u,y\n0,1,1,2\n", [](Configuration& c) { c.experiment.column = "runs"; },
       "experiment.column: "}};
}

class CsvDialects : public testing::TestWithParam<Dialect> {
 protected:
  LoadedData read() const {
    const TemporaryFolder folder;
    std::ofstream(folder / "log.csv", std::ios::binary) << GetParam().content;
    Configuration configuration;
    if (GetParam().configure) GetParam().configure(configuration);
    return readCsv(folder / "log.csv", configuration);
  }
};

using LoadedCsv = CsvDialects;

TEST_P(LoadedCsv, HasTheSamples) {
  const LoadedData data = read();
  ASSERT_EQ(data.experiments.size(), 1u)
      << (data.rejected.empty() ? "" : data.rejected.front().reason);
  const Experiment& experiment = data.experiments.front();
  EXPECT_EQ(experiment.sample_time, 0.5);
  EXPECT_EQ(experiment.u, Eigen::Vector3d(1.5, -2, 3));
  EXPECT_EQ(experiment.y, Eigen::Vector3d(10, 20.25, -0.5));
  EXPECT_TRUE(experiment.valid.empty());
}

INSTANTIATE_TEST_SUITE_P(Separators, LoadedCsv, testing::ValuesIn(separators()));
INSTANTIATE_TEST_SUITE_P(Headers, LoadedCsv, testing::ValuesIn(headers()));
INSTANTIATE_TEST_SUITE_P(Times, LoadedCsv, testing::ValuesIn(times()));
INSTANTIATE_TEST_SUITE_P(Dates, LoadedCsv, testing::ValuesIn(dates()));
INSTANTIATE_TEST_SUITE_P(Thousands, LoadedCsv, testing::ValuesIn(thousands()));
INSTANTIATE_TEST_SUITE_P(Cells, LoadedCsv, testing::ValuesIn(values()));

class RefusedCsv : public CsvDialects {};

TEST_P(RefusedCsv, SaysWhereAndWhatToWrite) {
  std::string message;
  try {
    const LoadedData data = read();
    EXPECT_TRUE(data.experiments.empty());
    ASSERT_EQ(data.rejected.size(), 1u);
    message = data.rejected.front().reason;
  } catch (const Error& error) {
    message = error.what();
  }
  EXPECT_TRUE(test::mentions(message, "log.csv")) << message;
  EXPECT_TRUE(test::mentions(message, GetParam().remedy)) << message;
}

INSTANTIATE_TEST_SUITE_P(Files, RefusedCsv, testing::ValuesIn(refused()));

}  // namespace
}  // namespace uncertainty_identification
