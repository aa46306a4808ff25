#include "io/command_line.h"

#include <iostream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "configuration/thread_count.h"
#include "io/memory.h"
#include "io/printable.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/version.h"

namespace uncertainty_identification {
namespace {

namespace po = boost::program_options;

po::options_description commonOptions() {
  po::options_description common("Help");
  common.add_options()("help,h", "print this text");
  common.add_options()("version", "print the version");
  return common;
}

po::variables_map parse(const Program& program, int argc, const char* const* argv) {
  po::options_description all;
  po::positional_options_description positional;
  all.add(program.options).add(commonOptions());
  if (!program.arguments.empty()) {
    all.add_options()(program.arguments.c_str(), po::value<std::vector<std::string>>());
    positional.add(program.arguments.c_str(), -1);
  }
  // Abbreviated options are refused: an abbreviation in a script could mean something else as soon
  // as another option is added.
  const int style = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  po::variables_map values;
  po::store(
      po::command_line_parser(argc, argv).options(all).positional(positional).style(style).run(),
      values);
  if (values.count("help") == 0 && values.count("version") == 0) po::notify(values);
  return values;
}

int parseAndRun(const Program& program, int argc, const char* const* argv) {
  const po::variables_map values = parse(program, argc, argv);
  if (values.count("help") > 0) {
    std::cout << "usage: " << program.name << ' ' << program.usage << "\n\n"
              << program.purpose << "\n\n"
              << program.options << '\n'
              << commonOptions();
    return kDone;
  }
  if (values.count("version") > 0) {
    std::cout << program.name << ' ' << version() << '\n';
    return kDone;
  }
  return program.run(values);
}

}  // namespace

int runProgram(const Program& program, int argc, const char* const* argv) {
  keepFreedMemory();
  useAllCores();
  const auto failed = [&program](int status, const std::string& message) {
    printMessage(program.name, message);
    return status;
  };
  try {
    return parseAndRun(program, argc, argv);
  } catch (const DataError& error) {
    return failed(kNoAnswer, error.what());
  } catch (const Error& error) {
    return failed(kUsageError, error.what());
  } catch (const po::error& error) {
    return failed(kUsageError, std::string(error.what()) + "; see " + program.name + " --help");
  } catch (const std::exception& error) {
    return failed(kNoAnswer, std::string("internal error: ") + error.what() +
                                 "\nThis is a fault of the program. Please report it with this "
                                 "message, the command line, the configuration and the data.");
  }
}

void printMessage(const std::string& program, const std::string& message) {
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);)
    std::cerr << program << ": " << printable(line) << '\n';
}

}  // namespace uncertainty_identification
