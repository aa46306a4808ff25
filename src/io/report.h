#pragma once

#include <string>

#include "io/report_files.h"
#include "uncertainty_identification/explanation/explanation.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {

/// Why no report can be written, and what to install; empty when one can be written.
std::string reportObstacle(const ReportFiles& files = reportFiles());

/// The result and its explanation (null: there is none) as an HTML page with figures. The page
/// contains everything it needs and opens without a network. Throws FileError when there is a
/// reportObstacle().
std::string reportHtml(const Result& result, const Explanation* explanation = nullptr,
                       const ReportFiles& files = reportFiles());

/// The page that draws what a running node tells it (docs/live_page.md), like a report's first
/// page. Throws FileError when there is a reportObstacle().
std::string livePageHtml(const ReportFiles& files = reportFiles());

/// Writes reportHtml(), all of it or nothing. Throws FileError.
void writeReport(const std::string& path, const Result& result,
                 const Explanation* explanation = nullptr);

}  // namespace uncertainty_identification
