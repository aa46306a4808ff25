#pragma once

#include <string>

#include "io/report_files.h"
#include "uncertainty_identification/explanation/explanation.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {

/// Why no report can be written: a sentence that says what to install; empty when one can.
std::string reportObstacle(const ReportFiles& files = reportFiles());

/// The result, and what its simulation gets wrong where that was explained (null: it was not), as
/// one HTML page for people, with figures. It holds all it needs: it opens without a network.
/// Throws FileError when there is a reportObstacle().
std::string reportHtml(const Result& result, const Explanation* explanation = nullptr,
                       const ReportFiles& files = reportFiles());

/// Writes reportHtml(), all of it or nothing. Throws FileError.
void writeReport(const std::string& path, const Result& result,
                 const Explanation* explanation = nullptr);

}  // namespace uncertainty_identification
