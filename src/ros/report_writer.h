#pragma once

#include <string>

#include "ros/messages.h"
#include "uncertainty_identification/explanation/explanation.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {

/// Writes reports of results into one folder, whoever asks: a name in a request never leads out.
class ReportWriter {
 public:
  /// `directory` empty: requests are refused.
  explicit ReportWriter(std::string directory) : directory_(std::move(directory)) {}

  /// Answers a request; `result` null: there is none yet; `explanation` null: the report has none.
  messages::WriteReport::Response answer(const messages::WriteReport::Request& request,
                                         const Result* result,
                                         const Explanation* explanation) const;

 private:
  std::string directory_;
};

}  // namespace uncertainty_identification
