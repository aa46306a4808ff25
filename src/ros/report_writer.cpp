#include "uncertainty_identification/ros/report_writer.h"

#include <algorithm>
#include <cctype>

#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/report.h"

namespace uncertainty_identification {
namespace {

using Response = messages::WriteReport::Response;

bool isPlainName(const std::string& name) {
  constexpr std::size_t kLongest = 200;
  const std::string ending = ".html";
  return name.size() <= kLongest && name.size() > ending.size() && name[0] != '.' &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0 &&
         std::all_of(name.begin(), name.end(), [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-';
         });
}

Response answerOf(std::uint8_t code, const std::string& message) {
  Response response;
  response.code = code;
  response.message = message;
  return response;
}

}  // namespace

Response ReportWriter::answer(const messages::WriteReport::Request& request,
                              const Result* result) const {
  if (directory_.empty()) {
    return answerOf(Response::REFUSED, "reports are refused until report_directory is configured");
  }
  const std::string name = request.name.empty() ? "report.html" : request.name;
  if (!isPlainName(name)) {
    return answerOf(Response::REFUSED, "name: found '" + name +
                                           "'; allowed: letters, digits, '.', '_' and '-', ending "
                                           "in .html, without a folder");
  }
  if (result == nullptr) return answerOf(Response::NONE_YET, "there is no result to report yet");
  try {
    Response response = answerOf(Response::OK, "");
    response.path = directory_ + "/" + name;
    writeReport(response.path, *result);
    return response;
  } catch (const Error& error) {
    return answerOf(Response::FILE_ERROR, error.what());
  }
}

}  // namespace uncertainty_identification
