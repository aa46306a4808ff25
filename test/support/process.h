#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace uncertainty_identification {

/// What a program left behind.
struct ProcessResult {
  int status = -1;     ///< exit status; minus the signal's number when one ended it
  std::string output;  ///< standard output
  std::string errors;  ///< standard error
};

/// A program that runs in parallel to the test; its outputs are not terminals.
class Process {
 public:
  /// Starts `command`: a path, then its arguments.
  explicit Process(const std::vector<std::string>& command);
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  pid_t id() const { return id_; }

  /// Waits until the program has a handler of its own for this signal, or has ended; false in the
  /// latter case.
  bool waitUntilItHandles(int signal) const;

  /// Waits for its end.
  ProcessResult wait();

 private:
  TemporaryFolder folder_;
  pid_t id_ = -1;
};

/// Runs a program to its end.
ProcessResult runProcess(const std::vector<std::string>& command);

}  // namespace uncertainty_identification
