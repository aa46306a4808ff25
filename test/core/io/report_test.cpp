#include "io/report.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "io/read_file.h"
#include "support/core_setup.h"
#include "support/error_message.h"
#include "support/example_explanation.h"
#include "support/plain_estimate.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/explanation_json.h"

namespace uncertainty_identification {
namespace {

Result someResult() {
  Result result{test::plainEstimate(test::vectorOf({1.0}), test::vectorOf({-0.5})), {}};
  result.estimate.configuration.bounds.frequencies = 50;
  result.estimate.configuration.bounds.weight_order = 1;
  result.bounds = computeBounds(result.estimate);
  return result;
}

/// As found when built; where there was none (Ubuntu 20.04), something in its place.
ReportFiles filesWithChart() {
  ReportFiles files = reportFiles();
  if (files.chart.empty()) files.chart = "/* Chart.js */";
  return files;
}

std::size_t occurrences(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
    ++count;
  return count;
}

/// What stands in the element of the result or the explanation.
nlohmann::json embedded(const std::string& html, const std::string& id = "result") {
  const std::string opening = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t begin = html.find(opening) + opening.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

TEST(Report, HoldsTheWholeResult) {
  const Result result = someResult();
  const std::string html = reportHtml(result, {}, filesWithChart());
  EXPECT_EQ(embedded(html), toJson(result));
  EXPECT_EQ(html.find("{{"), std::string::npos) << "something was not filled in";
  EXPECT_NE(html.find(reportFiles().script), std::string::npos);
  EXPECT_NE(html.find(reportFiles().style), std::string::npos);
}

TEST(Report, HoldsTheExplanationWhereThereIsOne) {
  const Result result = someResult();
  const Explanation explanation = test::exampleExplanation();
  const std::string html = reportHtml(result, &explanation, filesWithChart());
  EXPECT_EQ(embedded(html, "explanation"), toJson(explanation));
  EXPECT_EQ(embedded(html), toJson(result));
  EXPECT_TRUE(embedded(reportHtml(result, {}, filesWithChart()), "explanation").is_null());
}

/// Nothing is fetched: no element names another file, and the page forbids its browser to ask.
TEST(Report, NeedsNoOtherFile) {
  const std::string html = reportHtml(someResult(), {}, filesWithChart());
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  EXPECT_FALSE(std::regex_search(html, std::regex(R"(<(script|img|iframe|link)[^>]*\ssrc=)")));
  EXPECT_EQ(occurrences(html, "<link"), 1u);
  EXPECT_NE(html.find("<link rel=\"icon\" href=\"data:,\">"), std::string::npos);
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_LT(html.size(), 1500000u);
}

TEST(Report, TextFromUsersCannotBecomeMarkup) {
  Result result = someResult();
  const std::string evil = "</script><script>alert(1)</script><!--<script>{{chart}}\xff";
  result.estimate.experiments.push_back({evil, 10, {1.0, 0.0}, Eigen::VectorXd::Ones(1), -1});
  result.estimate.warnings.push_back("</SCRIPT>");
  const std::string html = reportHtml(result, {}, filesWithChart());
  EXPECT_EQ(html.find("alert(1)</script>"), std::string::npos);
  EXPECT_EQ(html.find("</SCRIPT>"), std::string::npos);
  EXPECT_EQ(occurrences(html, "</script>"), 4u) << "of the page's own four elements";
  const auto id = embedded(html)["experiments"]["estimates"][0]["id"];
  EXPECT_EQ(id, "</script><script>alert(1)</script><!--<script>{{chart}}\xef\xbf\xbd");
}

TEST(LivePageHtml, IsMadeOfTheReportsFilesAndFetchesItsEventsOnly) {
  const std::string html = livePageHtml(filesWithChart());
  EXPECT_EQ(html.find("{{"), std::string::npos) << "something was not filled in";
  EXPECT_NE(html.find(reportFiles().script), std::string::npos);
  EXPECT_NE(html.find(reportFiles().live_script), std::string::npos);
  EXPECT_NE(html.find(reportFiles().style), std::string::npos);
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  EXPECT_NE(html.find("connect-src 'self'"), std::string::npos);
  EXPECT_EQ(reportFiles().script.find(reportFiles().live_script), std::string::npos)
      << "no report needs it";
}

TEST(Report, NothingOfTheProgramsOwnEndsItsScript) {
  EXPECT_EQ(reportFiles().live_script.find("</script"), std::string::npos);
  EXPECT_EQ(reportFiles().script.find("</script"), std::string::npos);
  EXPECT_EQ(reportFiles().chart.find("</script"), std::string::npos);
}

TEST(Report, WithoutChartJsSaysWhatToInstall) {
  ReportFiles files = reportFiles();
  files.chart = "";
  EXPECT_NE(reportObstacle(files).find("libjs-chart.js"), std::string::npos);
  EXPECT_EQ(messageOf<FileError>([&] { reportHtml(someResult(), {}, files); }),
            reportObstacle(files));
  EXPECT_EQ(messageOf<FileError>([&] { livePageHtml(files); }), reportObstacle(files));
  EXPECT_EQ(reportObstacle(filesWithChart()), "");
}

/// What CMake makes of a Chart.js of this content: the version it takes, empty where it takes none.
std::string versionTaken(const std::string& content) {
  const TemporaryFolder folder;
  const std::string chart = folder / "chart.js", output = folder / "files.cpp";
  std::ofstream(chart) << content;
  const std::string project = PROJECT_FOLDER;
  const ProcessResult run =
      runProcess({"/usr/bin/env", "cmake", "-DSOURCE=" + project + "/report", "-DOUTPUT=" + output,
                  "-DCHART_JS=" + chart, "-P", project + "/cmake/report_files.cmake"});
  EXPECT_EQ(run.status, 0) << run.errors;
  const std::string written = readFile(output);
  std::smatch match;
  EXPECT_TRUE(std::regex_search(written, match, std::regex("kChart, \"(.*)\"\\}")));
  EXPECT_EQ(written.find("drawing;") != std::string::npos, match[1].length() > 0);
  return match[1];
}

TEST(Report, BuildsWithChartJsFromVersion3On) {
  EXPECT_EQ(versionTaken("/*!\n * Chart.js v3.9.1\n */ [drawing; \\x]"), "3.9.1");
  EXPECT_EQ(versionTaken("/*!\n * Chart.js v4.4.0\n */ drawing;"), "4.4.0");
  EXPECT_EQ(versionTaken("/*!\n * Chart.js v2.9.4\n */ drawing;"), "");
  EXPECT_EQ(versionTaken("drawing;"), "");
}

}  // namespace
}  // namespace uncertainty_identification
