#pragma once

#include <string>

namespace uncertainty_identification {

/// The parts of a report, built into this library by cmake/report_files.cmake.
struct ReportFiles {
  std::string page;         ///< HTML in which {{style}}, {{chart}}, {{script}}, {{result}} and
                            ///< {{explanation}} are replaced
  std::string style;        ///< CSS
  std::string script;       ///< JavaScript that draws a result with Chart.js
  std::string live_page;    ///< HTML in which {{style}}, {{chart}}, {{script}} and {{live_script}}
                            ///< are replaced
  std::string live_script;  ///< JavaScript that draws what a node tells
  std::string chart;        ///< Chart.js; empty when none was found
  std::string chart_version;
};

const ReportFiles& reportFiles();

}  // namespace uncertainty_identification
