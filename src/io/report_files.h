#pragma once

#include <string>

namespace uncertainty_identification {

/// What a report is made of, as it was when this library was built (cmake/report_files.cmake).
struct ReportFiles {
  std::string page;   ///< HTML with {{style}}, {{chart}}, {{script}} and {{result}} to be filled in
  std::string style;  ///< CSS
  std::string script;  ///< JavaScript that draws a result with Chart.js
  std::string chart;   ///< Chart.js; empty when none was found
  std::string chart_version;
};

const ReportFiles& reportFiles();

}  // namespace uncertainty_identification
