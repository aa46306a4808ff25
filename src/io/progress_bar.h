#pragma once

#include <ostream>

#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// One line on a terminal that shows where an identification stands, and clears itself at the end.
class ProgressBar {
 public:
  /// Writes nothing when `enabled` is false, as it should be unless `out` is a terminal.
  ProgressBar(std::ostream& out, bool enabled) : out_(out), enabled_(enabled) {}
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);

 private:
  std::ostream& out_;
  bool enabled_;
};

}  // namespace uncertainty_identification
