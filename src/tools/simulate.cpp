// Simulates experiments on a system whose truth is known; --help says how.

#include "simulation/simulate.h"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "io/command_line.h"
#include "io/output_file.h"
#include "io/truth_yaml.h"
#include "ros/bag_writer.h"
#include "uncertainty_identification/io/csv.h"

namespace {

namespace ui = uncertainty_identification;
namespace po = boost::program_options;
namespace fs = std::filesystem;

void writeFolder(const fs::path& folder, const std::vector<ui::Experiment>& experiments) {
  ui::makeEmptyFolder(folder.string());
  for (const ui::Experiment& experiment : experiments) {
    ui::writeCsv((folder / (experiment.id + ".csv")).string(), {experiment});
  }
}

bool isFile(const fs::path& output) {
  return output.extension() == ".bag" || output.extension() == ".csv";
}

void write(const fs::path& output, const std::vector<ui::Experiment>& experiments) {
  if (!isFile(output)) {
    writeFolder(output, experiments);
  } else if (output.extension() == ".bag") {
    ui::writeBag(output.string(), experiments);
  } else {
    ui::writeCsv(output.string(), experiments);
  }
}

int run(const po::variables_map& arguments) {
  const std::string answer = arguments["answer"].as<std::string>();
  const std::string config = arguments["config"].as<std::string>();
  const std::string output = arguments["output"].as<std::string>();
  const ui::Truth truth = ui::loadTruth(config);
  const auto seed = arguments["seed"].as<std::uint64_t>();
  if (!answer.empty()) ui::requireWritable(answer, {config, output});
  if (isFile(output)) ui::requireWritable(output, {config});
  write(output, ui::simulate(truth, seed));
  if (!answer.empty()) ui::writeFileAtomically(answer, ui::answerJson(truth, seed).dump(1) + "\n");
  return ui::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  ui::Program program;
  program.name = "simulate";
  program.usage =
      "--config TRUTH.yaml --output FILE.bag|FILE.csv|DIR [--answer answer.json] [--seed S]";
  program.purpose =
      R"(Simulates experiments on a known system, such as the paper's (config/example1_truth.yaml). The same
truth and seed give the same experiments, and an experiment does not depend on how many there are.
Exit status: 0 done; 1 an internal error; 2 wrong usage or configuration, or a file that cannot be
read or written.)";
  program.options.add_options()  //
      ("config", po::value<std::string>()->required()->value_name("FILE"),
       "the truth (YAML); config/truth_reference.yaml explains every key")  //
      ("output", po::value<std::string>()->required()->value_name("PATH"),
       "one .bag or .csv, or else a new folder of .csv files, one per experiment")  //
      ("answer", po::value<std::string>()->default_value("", "none")->value_name("FILE"),
       "where to write the truth and what was drawn for each experiment (JSON)")  //
      ("seed", po::value<std::uint64_t>()->default_value(1)->value_name("S"),
       "of all random numbers");
  program.run = run;
  return ui::runProgram(program, argc, argv);
}
