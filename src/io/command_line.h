#pragma once

#include <boost/program_options.hpp>
#include <functional>
#include <string>

namespace uncertainty_identification {

/// Exit status of every tool.
enum ExitStatus {
  kDone = 0,
  kNoAnswer = 1,   ///< the data cannot support an answer, cancelled, or an internal error
  kUsageError = 2  ///< wrong usage or configuration, or a file that cannot be read or written
};

/// A command-line program: what it takes and what it does. --help and --version are added to it.
struct Program {
  std::string name;     ///< starts every line on standard error
  std::string usage;    ///< what follows the name, e.g. "--config FILE DATA..."
  std::string purpose;  ///< one or more sentences
  boost::program_options::options_description options{"Options"};
  std::string arguments;  ///< name under which run() finds the arguments without an option, as a
                          ///< list of texts; empty: there must be none
  std::function<int(const boost::program_options::variables_map&)>
      run;  ///< returns the exit status
};

/// Parses the command line and runs the program, on all processor cores. Exceptions become a
/// message and an exit status: kNoAnswer for DataError; kUsageError for every other Error and for a
/// wrong command line; kNoAnswer for any other exception, which is a fault of the program and is
/// called one.
int runProgram(const Program& program, int argc, const char* const* argv);

/// Writes a message to standard error, each of its lines starting with the program's name. Bytes
/// that are no text, such as those of names from files, are escaped (printable.h).
void printMessage(const std::string& program, const std::string& message);

}  // namespace uncertainty_identification
