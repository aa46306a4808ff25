// Shows what is in recorded data before anything is identified from them; docs and --help say how.

#include <iostream>
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "io/command_line.h"
#include "io/inspection_html.h"
#include "io/inspection_text.h"
#include "io/inspection_yaml.h"
#include "io/output_file.h"
#include "ros/survey_data.h"
#include "tools/data_argument.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace {

namespace ui = uncertainty_identification;
namespace po = boost::program_options;

int run(const po::variables_map& arguments) {
  if (arguments.count("data") == 0)
    throw ui::ConfigurationError("no DATA given; see inspect --help");
  const auto paths = arguments["data"].as<std::vector<std::string>>();
  const bool has_config = arguments.count("config") > 0;
  std::vector<std::string> outputs;
  for (const char* output : {"write", "html"})
    if (arguments.count(output) > 0) outputs.push_back(arguments[output].as<std::string>());
  for (const std::string& output : outputs)
    ui::requireWritable(output, ui::inputArguments(arguments));
  ui::requireDistinct(outputs);
  const ui::Configuration configuration =
      has_config ? ui::loadConfiguration(arguments["config"].as<std::string>())
                 : ui::Configuration();
  const ui::InspectedData data = ui::inspectData(paths, configuration, has_config);
  std::cout << ui::inspectionText(data);
  if (arguments.count("html") > 0)
    ui::writeFileAtomically(arguments["html"].as<std::string>(), ui::inspectionHtml(data));
  if (arguments.count("write") == 0) {
    if (data.failure.empty() && !data.loaded.experiments.empty())
      std::cout << "\ninspect --write C.yaml writes a configuration that reads the data so.\n";
    return ui::kDone;
  }
  const auto path = arguments["write"].as<std::string>();
  ui::writeFileAtomically(path, ui::inspectionYaml(data));
  std::cout << "\nThe configuration was written to " << path << "; next: identify --config " << path
            << " --output result.json DATA...\n";
  return ui::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  ui::Program program;
  program.name = "inspect";
  program.usage = "[--config C.yaml] [--write C.yaml] [--html FILE] [--] DATA...";
  program.purpose =
      R"(Shows what is in recorded data: columns or topics with their rates, pauses and jitter; range, resolution
and shape of each signal; which signals could be input and output, and why; and into which experiments
the data would be cut. DATA is a .csv of any logger, a .bag, or a folder of such files.
Exit status: 0 done; 1 no configuration would work, or an internal error; 2 wrong usage or configuration,
or a file that cannot be read or written.)";
  program.options.add_options()  //
      ("config", po::value<std::string>()->value_name("FILE"),
       "configuration (YAML) whose input, output, time and experiments are taken")  //
      ("write", po::value<std::string>()->value_name("FILE"),
       "writes a configuration with comments that works with identify and explain")  //
      ("html", po::value<std::string>()->value_name("FILE"),
       "writes a page with what is printed and pictures of the experiments");
  program.arguments = "data";
  program.run = run;
  return ui::runProgram(program, argc, argv);
}
