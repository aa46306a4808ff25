#include "io/inspection_html.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

using test::mentions;

/// One record of 10 s at 10 Hz.
Channel drawnChannel(const std::string& name) {
  Channel channel;
  channel.name = channel.column = name;
  channel.records.resize(1);
  for (int k = 0; k <= 100; ++k) {
    channel.records.front().stamps.push_back(50 + 0.1 * k);
    channel.records.front().values.push_back(std::sin(0.3 * k));
  }
  return channel;
}

Experiment drawnExperiment(const std::string& id, double start, int samples) {
  Experiment experiment;
  experiment.id = id;
  experiment.sample_time = 0.1;
  experiment.start_time = start;
  experiment.u = Eigen::VectorXd::LinSpaced(samples, 0, 1);
  experiment.y = Eigen::VectorXd::LinSpaced(samples, 1, 0);
  return experiment;
}

/// A record from 50 s to 60 s of which 2.5 s and 5 s are experiments.
InspectedData drawnData() {
  InspectedData data;
  data.survey.records = 1;
  data.survey.channels = {drawnChannel("cmd"), drawnChannel("speed")};
  for (const Channel& channel : data.survey.channels) data.measures.push_back(measure(channel));
  data.choice.chosen = SignalPair{0, 1, {}, 1};
  data.loaded.experiments = {drawnExperiment("first", 50, 25), drawnExperiment("second", 55, 50)};
  return data;
}

long countOf(const std::string& part, const std::string& page) {
  long count = 0;
  for (auto at = page.find(part); at != std::string::npos; at = page.find(part, at + 1)) ++count;
  return count;
}

/// The points of the n-th line of this class.
std::vector<std::pair<double, double>> pointsOf(const std::string& page, const std::string& style,
                                                int n) {
  std::size_t at = 0;
  for (int k = 0; k <= n; ++k) at = page.find("<polyline class=\"" + style + "\"", at + 1);
  const std::string line = page.substr(at, page.find("/>", at) - at);
  const std::regex point("([-0-9.]+),([-0-9.]+) ");
  std::vector<std::pair<double, double>> points;
  for (std::sregex_iterator each(line.begin(), line.end(), point), end; each != end; ++each)
    points.emplace_back(std::stod((*each)[1]), std::stod((*each)[2]));
  return points;
}

TEST(InspectionPage, ShowsNamesFromFilesAsTextOnly) {
  InspectedData data = drawnData();
  data.survey.channels[0].name = "<script>alert(1)</script>";
  data.survey.channels[1].name = "a&b \x1b[31m \xB0";
  data.loaded.experiments[0].id = "<img src=x onerror=alert(2)>";
  data.loaded.warnings = {"</pre><script>"};
  data.loaded.rejected = {{"bad", "<b>constant"}};
  data.survey.remarks = {"<i>remark"};
  data.failure = "<u>failure";
  const std::string page = inspectionHtml(data);
  for (const char* markup : {"<script", "<img", "</pre><", "<b>", "<i>", "<u>"})
    EXPECT_EQ(countOf(markup, page), 0) << markup;
  EXPECT_TRUE(mentions(page, "<h3>&lt;img src=x onerror=alert(2)>"));
  EXPECT_TRUE(mentions(page, "y=\"12\">&lt;script>alert(1)&lt;/script>: "));
  EXPECT_TRUE(mentions(page, "y=\"12\">a&amp;b \\x1B[31m \\xB0: ")) << "valid UTF-8";
}

TEST(InspectionPage, ShowsATopicThatCutsAsTextOnly) {
  InspectedData data = drawnData();
  data.configuration.experiment.topic = "/a\x1b[31m<b>";
  EXPECT_TRUE(mentions(inspectionHtml(data), "lasts while /a\\x1B[31m&lt;b> is true"));
}

TEST(InspectionPage, NeedsNothingElse) {
  const std::string page = inspectionHtml(drawnData());
  for (const char* part : {"http", "src=", "href", "url(", "@import", "<script"})
    EXPECT_FALSE(mentions(page, part)) << part;
  EXPECT_TRUE(mentions(page, "<meta charset=\"utf-8\">"));
  for (const char* tag : {"svg", "g", "pre", "h2", "h3", "html", "body"}) {
    const std::string name = tag;
    const long opened = countOf("<" + name + ">", page) + countOf("<" + name + " ", page);
    EXPECT_GT(opened, 0) << name;
    EXPECT_EQ(opened, countOf("</" + name + ">", page)) << name;
  }
}

TEST(InspectionPage, MarksTheExperimentsWhereTheyLieInTheRecord) {
  const std::string page = inspectionHtml(drawnData());
  EXPECT_EQ(countOf("<rect ", page), 2);
  EXPECT_TRUE(mentions(page, "<rect x=\"0.0\" y=\"0\" width=\"180.0\" height=\"180.0\"/>"));
  EXPECT_TRUE(mentions(page, "<rect x=\"360.0\" y=\"0\" width=\"360.0\" height=\"180.0\"/>"));
}

TEST(InspectionPage, DrawsInputAboveOutputOfRecordAndExperiments) {
  const std::string page = inspectionHtml(drawnData());
  EXPECT_EQ(countOf("<polyline class=\"u\"", page), 3);
  EXPECT_EQ(countOf("<polyline class=\"y\"", page), 3);
  EXPECT_EQ(countOf("<g transform=\"translate(0 90.0)\">", page), 3) << "the outputs";
  const auto input = pointsOf(page, "u", 1), output = pointsOf(page, "y", 1);
  ASSERT_EQ(input.size(), 25u);
  ASSERT_EQ(output.size(), 25u);
  EXPECT_EQ(input.front(), std::pair(0.0, 86.0)) << "the input rises from below";
  EXPECT_EQ(input.back().second, 4);
  EXPECT_EQ(output.front(), std::pair(0.0, 4.0));
  EXPECT_NEAR(output.back().first, 720 * 24 / 25.0, 0.1);
}

TEST(InspectionPage, LeavesOutMissingOutputs) {
  InspectedData data = drawnData();
  Experiment& experiment = data.loaded.experiments[0];
  experiment.valid.assign(25, 1);
  for (const std::size_t k : {3, 4, 5}) experiment.valid[k] = 0;
  experiment.y.segment(3, 3).setConstant(std::nan(""));
  std::string page = inspectionHtml(data);
  EXPECT_EQ(pointsOf(page, "y", 1).size(), 22u);
  EXPECT_EQ(pointsOf(page, "u", 1).size(), 25u);
  EXPECT_FALSE(mentions(page, "nan"));
  experiment.valid.assign(25, 0);
  page = inspectionHtml(data);
  EXPECT_EQ(countOf("<polyline class=\"y\"", page), 2) << "there is no output to draw";
}

TEST(InspectionPage, KeepsThePeaksOfALongExperiment) {
  InspectedData data = drawnData();
  Experiment& experiment = data.loaded.experiments[0] = drawnExperiment("long", 50, 100000);
  experiment.u.setZero();
  experiment.u[54321] = 1;
  experiment.u[77777] = -1;
  const auto points = pointsOf(inspectionHtml(data), "u", 1);
  EXPECT_LT(points.size(), 1000u) << "thinned";
  const auto has = [&](double x, double y) {
    return std::any_of(points.begin(), points.end(), [&](const auto& point) {
      return std::abs(point.first - x) < 0.06 && point.second == y;
    });
  };
  EXPECT_TRUE(has(720 * 0.54321, 4)) << "the only sample at 1";
  EXPECT_TRUE(has(720 * 0.77777, 86)) << "the only sample at -1";
}

TEST(InspectionPage, OfManyExperimentsDrawsTheFirstAndCountsTheOthers) {
  InspectedData data = drawnData();
  data.loaded.experiments.clear();
  for (int k = 0; k < 30; ++k)
    data.loaded.experiments.push_back(drawnExperiment("run" + std::to_string(k), 50, 3));
  const std::string page = inspectionHtml(data);
  EXPECT_EQ(countOf("<h3>", page), 24);
  EXPECT_TRUE(mentions(page, "<h3>run23, "));
  EXPECT_TRUE(mentions(page, "<p>and 6 more</p>"));
}

TEST(InspectionPage, WithoutExperimentsOrAPairIsTextOnly) {
  InspectedData data = drawnData();
  data.loaded.experiments.clear();
  data.choice = {};
  data.choice.doubt = "no two signals move in the same record";
  const std::string page = inspectionHtml(data);
  EXPECT_FALSE(mentions(page, "<svg"));
  EXPECT_FALSE(mentions(page, "<h2>"));
  EXPECT_TRUE(mentions(page, "Cannot tell: no two signals move in the same record."));
}

TEST(InspectionPage, DrawsSignalsThatDoNotMove) {
  InspectedData data = drawnData();
  data.loaded.experiments = {drawnExperiment("still", 50, 25)};
  data.loaded.experiments[0].u.setConstant(4);
  const std::string page = inspectionHtml(data);
  EXPECT_TRUE(mentions(page, "u: 4 to 4<"));
  for (const auto& point : pointsOf(page, "u", 1)) EXPECT_EQ(point.second, 86);
}

}  // namespace
}  // namespace uncertainty_identification
