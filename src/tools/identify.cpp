// Identifies the nominal model and its uncertainty from recorded experiments; docs and --help say
// how.

#include <unistd.h>

#include <ctime>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "io/command_line.h"
#include "io/interrupt.h"
#include "io/output_file.h"
#include "io/progress_bar.h"
#include "io/result_text.h"
#include "tools/data_argument.h"
#include "uncertainty_identification/baselines/baseline.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/io/result_json.h"

namespace {

namespace ui = uncertainty_identification;
namespace po = boost::program_options;

const char* const kName = "identify";

/// None: the stochastic embedding.
std::optional<ui::BaselineMethod> methodOf(const po::variables_map& arguments) {
  const std::string method = arguments["method"].as<std::string>();
  if (method == "se") return {};
  for (const auto& [baseline, name] : ui::enumNames(ui::BaselineMethod())) {
    if (method == name) return baseline;
  }
  throw ui::ConfigurationError("--method: found '" + method + "'; allowed: se, mem, pem");
}

/// Bounds of a usable model; what cannot be had is told by the warnings: the model is worth keeping
/// without it.
std::optional<ui::Bounds> boundsOf(const std::vector<ui::Experiment>& experiments,
                                   const ui::ProgressCallback& progress, ui::Estimate* estimate) {
  std::optional<ui::Bounds> bounds;
  if (estimate->configuration.bounds.frequencies == 0 || !estimate->usable()) return bounds;
  try {
    bounds = ui::computeBounds(*estimate);
    auto prediction =
        ui::Identifier(estimate->configuration).calibrate(*estimate, experiments, progress);
    estimate->trust = ui::trustAfterCalibration(std::move(estimate->trust), prediction);
    bounds->trust = estimate->trust;
    if (!prediction.folds.empty()) bounds->prediction = std::move(prediction);
  } catch (const ui::DataError& error) {
    const std::string what = bounds ? "no calibrated prediction: " : "no bounds: ";
    estimate->warnings.push_back(what + error.what());
  }
  return bounds;
}

/// The files or folders that were named, without their folders.
std::vector<std::string> namesOf(const po::variables_map& arguments, const std::string& key) {
  std::vector<std::string> names;
  if (arguments.count(key) == 0) return names;
  for (const std::string& path : arguments[key].as<std::vector<std::string>>()) {
    const std::size_t end = path.find_last_not_of('/') + 1, begin = path.rfind('/', end - 1) + 1;
    names.push_back(path.substr(begin, end - begin));
  }
  return names;
}

std::string dateNow() {
  char text[32];
  const std::time_t now = std::time(nullptr);
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M", std::gmtime(&now));
  return text;
}

/// What a report says first: the plant in physical terms, runs to look at, and the origin.
void addOverview(const po::variables_map& arguments, const std::vector<ui::Experiment>& training,
                 const std::vector<ui::Experiment>& validation, ui::Result* result) {
  const ui::Estimate& estimate = result->estimate;
  if (!estimate.usable()) return;
  std::optional<ui::PlantDistribution> plants;
  if (result->bounds) plants.emplace(estimate);
  result->physical = ui::physicalNumbers(estimate, plants ? &*plants : nullptr);
  const bool calibrated = result->bounds && result->bounds->prediction;
  result->runs = ui::simulatedRuns(estimate, calibrated ? &*result->bounds->prediction : nullptr,
                                   training, validation);
  result->origin = {dateNow(), namesOf(arguments, "data"), namesOf(arguments, "validation")};
}

/// By the method asked for. A baseline's estimate is a mean, not a distribution of plants: its
/// region is its own.
ui::Result identify(const po::variables_map& arguments,
                    const std::optional<ui::BaselineMethod>& method,
                    const ui::InterruptGuard& interrupt) {
  const ui::Configuration configuration = ui::configurationArgument(arguments, kName);
  const ui::Identifier identifier(configuration);
  if (method && arguments.count("validation") > 0) {
    throw ui::ConfigurationError("--validation: found with --method " +
                                 arguments["method"].as<std::string>() +
                                 ", which measures nothing on other experiments; allowed: with se");
  }
  const ui::LoadedArguments loaded = ui::loadArguments(arguments, configuration);
  const ui::LoadedData &data = loaded.data, &validation = loaded.validation;
  ui::ProgressBar bar(std::cerr, isatty(STDERR_FILENO) != 0);
  const auto progress = [&](const ui::Progress& at) {
    bar.show(at);
    return !interrupt.requested();
  };
  ui::Result result;
  if (method) {
    ui::BaselineResult found = ui::identifyBaseline(*method, configuration, data.experiments);
    result = {std::move(found.estimate), {}, std::move(found.baseline)};
  } else {
    result.estimate = identifier.identify(data.experiments, validation.experiments, progress);
  }
  for (const ui::LoadedData* part : {&data, &validation}) {
    ui::Estimate& estimate = result.estimate;
    estimate.rejected.insert(estimate.rejected.end(), part->rejected.begin(), part->rejected.end());
    ui::addWarnings(*part, &estimate.warnings);
  }
  if (!method) result.bounds = boundsOf(data.experiments, progress, &result.estimate);
  addOverview(arguments, data.experiments, validation.experiments, &result);
  return result;
}

int run(const po::variables_map& arguments) {
  const std::optional<ui::BaselineMethod> method = methodOf(arguments);
  if (arguments.count("data") == 0) {
    throw ui::ConfigurationError("no DATA given; see identify --help");
  }
  const std::string output = arguments["output"].as<std::string>();
  ui::requireWritable(output, ui::inputArguments(arguments));
  const ui::InterruptGuard interrupt;
  const ui::Result result = identify(arguments, method, interrupt);
  const ui::Estimate& estimate = result.estimate;
  if (interrupt.requested() || estimate.termination == ui::Termination::cancelled) {
    ui::printMessage(kName, "cancelled; nothing was written");
    return ui::kNoAnswer;
  }
  if (!estimate.usable()) {
    throw ui::DataError("no usable model was found, nothing was written: " + estimate.message);
  }
  ui::saveResult(output, result);
  std::cout << ui::resultText(estimate, result.physical.sentence);
  if (result.bounds) std::cout << ui::boundsText(*result.bounds);
  if (result.baseline) std::cout << ui::baselineText(*result.baseline);
  return ui::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  ui::Program program;
  program.name = kName;
  program.usage = "[--config C.yaml] --output result.json [--validation DATA]... [--] DATA...";
  program.purpose =
      R"(Estimates the nominal model, the noise model and the distribution of the model's error from
experiments, and writes them to a JSON file. DATA is a .bag, a .csv with the columns experiment,t,u,y
or t,u,y or with columns that the configuration names, or a folder of such files.
Exit status: 0 done; 1 the data cannot support an answer, cancelled, or an internal error; 2 wrong
usage or configuration, or a file that cannot be read or written.)";
  program.options.add_options()  //
      ("config", po::value<std::string>()->value_name("FILE"),
       "configuration (YAML); config/reference.yaml explains every key; without it every default "
       "is taken, and input and output by their names (inspect shows them)")  //
      ("output", po::value<std::string>()->required()->value_name("FILE"),
       "where the result goes (JSON)")  //
      ("method", po::value<std::string>()->default_value("se")->value_name("NAME"),
       "se: stochastic embedding with a Gaussian mixture; pem: prediction-error fits of each "
       "experiment by itself; mem: model error modelling on their mean")  //
      ("validation", po::value<std::vector<std::string>>()->composing()->value_name("DATA"),
       "data used only to measure the fit; may be repeated");
  program.arguments = "data";
  program.run = run;
  return ui::runProgram(program, argc, argv);
}
