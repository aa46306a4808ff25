// Draws plants from an identified model; docs and --help say how.

#include <cstdint>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "bounds/frequency_grid.h"
#include "configuration/require.h"
#include "io/atomic_file.h"
#include "io/command_line.h"
#include "io/output_file.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/result_json.h"
#include "uncertainty_identification/io/samples_json.h"

namespace {

namespace ui = uncertainty_identification;
namespace po = boost::program_options;

ui::Uncertainty uncertaintyOf(const std::string& name) {
  if (name == "total") return ui::Uncertainty::total;
  if (name == "mixture") return ui::Uncertainty::mixture;
  throw ui::ConfigurationError("--uncertainty: found '" + name + "'; allowed: total, mixture");
}

int run(const po::variables_map& arguments) {
  const int count = arguments["count"].as<int>(), points = arguments["frequencies"].as<int>();
  ui::requireRange("--count", count, 1, 1000000);
  ui::requireRange("--frequencies", points, 10, 100000);
  const ui::Uncertainty uncertainty = uncertaintyOf(arguments["uncertainty"].as<std::string>());
  const std::string output = arguments["output"].as<std::string>();
  const std::string model = arguments["model"].as<std::string>();
  ui::requireWritable(output, {model});
  const ui::Estimate estimate = ui::loadResult(model).estimate;
  const auto seed = arguments["seed"].as<std::uint64_t>();
  const ui::PlantSamples plants = ui::PlantDistribution(estimate).draw(count, uncertainty, seed);
  const Eigen::VectorXd omega = ui::frequencyGrid(estimate.nominal_model, points);
  nlohmann::json tree = ui::toJson(plants, omega);
  tree["seed"] = seed;
  tree["data_fingerprint"] = estimate.data_fingerprint;
  ui::writeFileAtomically(output, tree.dump() + "\n");
  std::cout << count << " plants written to " << output << "\n";
  return ui::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  ui::Program program;
  program.name = "sample";
  program.usage = "--model result.json --count N --output samples.json";
  program.purpose =
      R"(Draws plants from the distribution that a result stands for, for Monte Carlo studies and for tools
that take an array of models.
Exit status: 0 done; 1 the result does not determine the distribution, or an internal error; 2 wrong
usage, or a file that cannot be read or written.)";
  program.options.add_options()  //
      ("model", po::value<std::string>()->required()->value_name("FILE"),
       "result.json of identify")                                                   //
      ("count", po::value<int>()->required()->value_name("N"), "number of plants")  //
      ("output", po::value<std::string>()->required()->value_name("FILE"),
       "where they go (JSON)")  //
      ("uncertainty", po::value<std::string>()->default_value("total")->value_name("NAME"),
       "total: the plant's spread and the errors of the estimate; mixture: the spread alone")  //
      ("frequencies", po::value<int>()->default_value(100)->value_name("N"),
       "points of the frequency responses, at least 10")  //
      ("seed", po::value<std::uint64_t>()->default_value(1)->value_name("S"),
       "the same seed draws the same plants");
  program.run = run;
  return ui::runProgram(program, argc, argv);
}
