#pragma once

#include <boost/program_options.hpp>
#include <functional>
#include <string>

namespace uncertainty_identification {

/// Exit status of every tool.
enum ExitStatus { kDone = 0, kDataCannotAnswer = 1, kUsageError = 2 };

/// A command-line program: what it takes and what it does. --help and --version come by themselves.
struct Program {
  std::string name;     ///< starts every line on standard error
  std::string usage;    ///< what follows the name, e.g. "--config FILE DATA..."
  std::string purpose;  ///< one or more sentences
  boost::program_options::options_description options{"Options"};
  std::string arguments;  ///< the key under which arguments without an option are found, as a list
                          ///< of texts; empty = none
  std::function<int(const boost::program_options::variables_map&)>
      run;  ///< returns the exit status
};

/// Parses the command line and runs the program. Exceptions become a message and an exit status:
/// DataError 1, everything else (configuration, files, usage) 2.
int runProgram(const Program& program, int argc, const char* const* argv);

/// Writes a message to standard error, each of its lines starting with the program's name.
void printMessage(const std::string& program, const std::string& message);

}  // namespace uncertainty_identification
