#include "io/report.h"

#include <map>
#include <nlohmann/json.hpp>

#include "io/atomic_file.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/explanation_json.h"

namespace uncertainty_identification {
namespace {

/// JSON for a <script> element. It contains no "<", so that no id or message can end the element.
std::string embeddable(const nlohmann::json& json) {
  // Ids come from users: one that is not UTF-8 must not prevent the report from being written.
  const std::string text = json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char character : text) {
    if (character == '<') {
      safe += "\\u003c";
    } else {
      safe += character;
    }
  }
  return safe;
}

/// The page with each {{name}} replaced by its part. Parts are not searched for names themselves.
std::string filled(const std::string& page, const std::map<std::string, std::string>& parts) {
  std::string text;
  std::size_t done = 0;
  for (std::size_t begin = 0; (begin = page.find("{{", done)) != std::string::npos;) {
    const std::size_t end = page.find("}}", begin);
    text += page.substr(done, begin - done) + parts.at(page.substr(begin + 2, end - begin - 2));
    done = end + 2;
  }
  return text + page.substr(done);
}

void requireDrawable(const ReportFiles& files) {
  const std::string obstacle = reportObstacle(files);
  if (!obstacle.empty()) throw FileError(obstacle);
}

}  // namespace

std::string reportObstacle(const ReportFiles& files) {
  if (!files.chart.empty()) return "";
  return "reports need Chart.js 3 or newer, which was not found when this program was built; "
         "install "
         "libjs-chart.js (Debian 12) or configure with -DCHART_JS=/path/to/chart.min.js, and build "
         "again";
}

std::string reportHtml(const Result& result, const Explanation* explanation,
                       const ReportFiles& files) {
  requireDrawable(files);
  const nlohmann::json explained = explanation ? toJson(*explanation) : nlohmann::json();
  return filled(files.page, {{"style", files.style},
                             {"chart", files.chart},
                             {"script", files.script},
                             {"result", embeddable(toJson(result))},
                             {"explanation", embeddable(explained)}});
}

std::string livePageHtml(const ReportFiles& files) {
  requireDrawable(files);
  return filled(files.live_page, {{"style", files.style},
                                  {"chart", files.chart},
                                  {"script", files.script},
                                  {"live_script", files.live_script}});
}

void writeReport(const std::string& path, const Result& result, const Explanation* explanation) {
  writeFileAtomically(path, reportHtml(result, explanation));
}

}  // namespace uncertainty_identification
