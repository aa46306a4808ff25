#include "ros/report_writer.h"

#include "io/report.h"
#include "ros/answer.h"
#include "session/file_name.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Response = messages::WriteReport::Response;

}  // namespace

Response ReportWriter::answer(const messages::WriteReport::Request& request, const Result* result,
                              const Explanation* explanation) const {
  if (directory_.empty()) {
    return answerOf<Response>(Response::REFUSED,
                              "reports are refused until report_directory is configured");
  }
  const std::string name = request.name.empty() ? "report.html" : request.name;
  if (!isPlainFileName(name, ".html")) {
    return answerOf<Response>(Response::REFUSED,
                              "name: found '" + name +
                                  "'; allowed: letters, digits, '.', '_' and '-', ending "
                                  "in .html, without a folder");
  }
  if (result == nullptr)
    return answerOf<Response>(Response::NONE_YET, "there is no result to report yet");
  try {
    Response response = answerOf<Response>(Response::OK, "");
    response.path = directory_ + "/" + name;
    writeReport(response.path, *result, explanation);
    return response;
  } catch (const Error& error) {
    return answerOf<Response>(Response::FILE_ERROR, error.what());
  }
}

}  // namespace uncertainty_identification
