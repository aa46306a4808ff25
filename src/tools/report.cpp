// Writes a result as an HTML page for people.

#include "uncertainty_identification/io/report.h"

#include <string>
#include <vector>

#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/command_line.h"
#include "uncertainty_identification/io/output_file.h"

namespace {

namespace ui = uncertainty_identification;
namespace po = boost::program_options;

const char* const kName = "report";

std::string resultFile(const po::variables_map& arguments) {
  if (arguments.count("result") == 0) {
    throw ui::ConfigurationError("no result.json given; see report --help");
  }
  const auto& files = arguments["result"].as<std::vector<std::string>>();
  if (files.size() > 1) {
    throw ui::ConfigurationError(files[1] +
                                 ": explanations are not available in this version; give one "
                                 "result.json");
  }
  return files[0];
}

int run(const po::variables_map& arguments) {
  const std::string input = resultFile(arguments);
  const std::string obstacle = ui::reportObstacle();
  if (!obstacle.empty()) {
    ui::printMessage(kName, obstacle);
    return ui::kDataCannotAnswer;
  }
  const std::string output = arguments["output"].as<std::string>();
  ui::requireWritable(output);
  ui::writeReport(output, ui::loadResult(input));
  return ui::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  ui::Program program;
  program.name = kName;
  program.usage = "--output report.html [--] result.json";
  program.purpose =
      R"(Writes what identify found as one HTML page with figures, which opens in any browser and needs no
network. Exit status: 0 done; 1 built without Chart.js; 2 usage or a file that cannot be read.)";
  program.options.add_options()  //
      ("output", po::value<std::string>()->required()->value_name("FILE"),
       "where the report goes (HTML)");
  program.arguments = "result";
  program.run = run;
  return ui::runProgram(program, argc, argv);
}
