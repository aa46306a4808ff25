// Writes a result as an HTML page for people.

#include "io/report.h"

#include <optional>
#include <string>
#include <vector>

#include "io/command_line.h"
#include "io/output_file.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/explanation_json.h"

namespace {

namespace ui = uncertainty_identification;
namespace po = boost::program_options;

const char* const kName = "report";

/// result.json, and explanation.json where it is given.
std::vector<std::string> inputFiles(const po::variables_map& arguments) {
  if (arguments.count("files") == 0) {
    throw ui::ConfigurationError("no result.json given; see report --help");
  }
  const auto& files = arguments["files"].as<std::vector<std::string>>();
  if (files.size() > 2) {
    throw ui::ConfigurationError(files[2] +
                                 ": a report holds one result.json and one explanation.json");
  }
  return files;
}

int run(const po::variables_map& arguments) {
  const std::vector<std::string> files = inputFiles(arguments);
  const std::string obstacle = ui::reportObstacle();
  if (!obstacle.empty()) {
    ui::printMessage(kName, obstacle);
    return ui::kNoAnswer;
  }
  const std::string output = arguments["output"].as<std::string>();
  ui::requireWritable(output, files);
  const ui::Result result = ui::loadResult(files[0]);
  std::optional<ui::Explanation> explanation;
  if (files.size() > 1) explanation = ui::loadExplanation(files[1]);
  ui::writeReport(output, result, explanation ? &*explanation : nullptr);
  return ui::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  ui::Program program;
  program.name = kName;
  program.usage = "--output report.html [--] result.json [explanation.json]";
  program.purpose =
      R"(Writes what identify found, and explain where its file is given too, as one HTML page with figures,
which opens in any browser and needs no network.
Exit status: 0 done; 1 built without Chart.js, or an internal error; 2 wrong usage, or a file that
cannot be read or written.)";
  program.options.add_options()  //
      ("output", po::value<std::string>()->required()->value_name("FILE"),
       "where the report goes (HTML)");
  program.arguments = "files";
  program.run = run;
  return ui::runProgram(program, argc, argv);
}
