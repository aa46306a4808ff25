#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace uncertainty_identification {

/// A program that answers lines with lines on its standard input and output. It runs in a process
/// group of its own, which the destructor ends: nothing of it is left.
class ChildProcess {
 public:
  /// Starts the program with at most `memory_limit` [MB]; the first entry is searched for as a
  /// shell does. Throws ConfigurationError where it cannot be started.
  ChildProcess(const std::vector<std::string>& command, double memory_limit);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Sends a line, which ends with a newline, and returns the next line that the program writes,
  /// without it. Throws DataError, saying what happened and how the standard error ended, where the
  /// program ends, does not answer within `seconds`, or writes more than `most_bytes` into one
  /// line.
  std::string ask(const std::string& line, double seconds, std::size_t most_bytes);

 private:
  [[noreturn]] void fail(const std::string& what);
  bool exchange(int milliseconds, const std::string& line, std::size_t* sent);
  void readErrors();
  std::string endText();
  void end();

  const double memory_limit_;
  pid_t process_ = -1;
  int channel_ = -1;  ///< socket that is the program's standard input and output
  int errors_ = -1;   ///< pipe of its standard error
  std::string received_, error_text_;
  bool closed_ = false;  ///< the program has closed its output
};

}  // namespace uncertainty_identification
