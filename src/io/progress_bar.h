#pragma once

#include <ostream>

#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// A line on a terminal that shows the progress of an identification. The destructor clears it.
class ProgressBar {
 public:
  /// Writes nothing unless `enabled`, which should be true only if `out` is a terminal.
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
