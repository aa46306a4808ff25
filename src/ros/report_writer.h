#pragma once

#include <string>

#include "ros/messages.h"
#include "uncertainty_identification/explanation/explanation.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {

/// Writes reports of results into one folder. Names in requests cannot lead out of it.
class ReportWriter {
 public:
  /// If `directory` is empty, all requests are refused.
  explicit ReportWriter(std::string directory) : directory_(std::move(directory)) {}

  /// Writes a report and answers the request. `result` is null if there is none yet; `explanation`
  /// is null if the report shall contain none.
  messages::WriteReport::Response answer(const messages::WriteReport::Request& request,
                                         const Result* result,
                                         const Explanation* explanation) const;

 private:
  std::string directory_;
};

}  // namespace uncertainty_identification
