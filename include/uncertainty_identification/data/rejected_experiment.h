#pragma once

#include <string>

namespace uncertainty_identification {

/// An experiment that was left out, while the others are used.
struct RejectedExperiment {
  std::string id;
  std::string reason;  ///< what was found and what to record instead
};

}  // namespace uncertainty_identification
