// Says what the identified model gets wrong, why, and what naming the cause gains; docs and --help
// say how.

#include <unistd.h>

#include <iostream>
#include <string>
#include <vector>

#include "export/extended_simulation.h"
#include "io/command_line.h"
#include "io/explanation_text.h"
#include "io/interrupt.h"
#include "io/open_simulation.h"
#include "io/output_file.h"
#include "io/progress_bar.h"
#include "tools/data_argument.h"
#include "tools/own_comparison.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/explanation/explanation.h"
#include "uncertainty_identification/io/explanation_json.h"

namespace {

namespace ui = uncertainty_identification;
namespace po = boost::program_options;

const char* const kName = "explain";

/// What loading left out and noticed, beside what the explanation found itself.
void addFindings(const ui::LoadedData& loaded, ui::Explanation* explanation) {
  const auto append = [](const auto& from, auto* to) {
    to->insert(to->end(), from.begin(), from.end());
  };
  ui::addWarnings(loaded, &explanation->warnings);
  append(loaded.rejected, &explanation->before.rejected);
  append(loaded.rejected, &explanation->after.rejected);
}

struct Answer {
  ui::Explanation explanation;
  std::vector<ui::Experiment> compared;  ///< with a simulation of the user's
};

Answer explain(const po::variables_map& arguments, const ui::Configuration& configuration,
               const ui::InterruptGuard& interrupt) {
  const ui::LoadedArguments loaded =
      ui::loadArguments(arguments, ui::withLoggedSimulation(configuration));
  ui::ProgressBar bar(std::cerr, isatty(STDERR_FILENO) != 0);
  const auto progress = [&](const ui::Progress& at) {
    bar.show(at);
    return !interrupt.requested();
  };
  const ui::OwnComparison own = ui::compareOwn(configuration, loaded.data.experiments,
                                               loaded.validation.experiments, progress);
  ui::Explanation explanation = ui::explain(configuration, own.data, own.validation, progress);
  explanation.own_simulation = own.findings;
  for (const ui::LoadedData* part : {&loaded.data, &loaded.validation})
    addFindings(*part, &explanation);
  return {explanation, own.compared};
}

int run(const po::variables_map& arguments) {
  if (arguments.count("data") == 0) {
    throw ui::ConfigurationError("no DATA given; see explain --help");
  }
  const std::string output = arguments["output"].as<std::string>();
  ui::requireWritable(output, ui::inputArguments(arguments));
  const ui::Configuration configuration = ui::configurationArgument(arguments, kName);
  const std::string folder = arguments["write-extended"].as<std::string>();
  if (!folder.empty())
    ui::requireExtendedWritable(folder, configuration, ui::inputArguments(arguments), output);
  const ui::InterruptGuard interrupt;
  const auto& [explanation, compared] = explain(arguments, configuration, interrupt);
  if (interrupt.requested() || explanation.termination == ui::Termination::cancelled) {
    ui::printMessage(kName, "cancelled; nothing was written");
    return ui::kNoAnswer;
  }
  if (!explanation.before.usable()) {
    throw ui::DataError("no usable model was found, nothing was written: " +
                        explanation.before.message);
  }
  ui::saveExplanation(output, explanation);
  if (!folder.empty())
    ui::writeExtendedSimulation(folder, *configuration.simulation, *explanation.own_simulation,
                                compared);
  std::cout << ui::explanationText(explanation);
  return ui::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  ui::Program program;
  program.name = kName;
  program.usage =
      "[--config C.yaml] --output explanation.json [--validation DATA]... [--write-extended "
      "FOLDER] "
      "[--] DATA...";
  program.purpose =
      R"(Identifies the model from experiments, shows where its simulation and the data part, names the cause,
takes it into the model and measures what that gains on experiments not used for fitting. DATA is a
.bag, a .csv with the columns experiment,t,u,y or t,u,y, or a folder of such files; further columns
are covariates, in which a cause may be found. Where the configuration gives a simulation of your own
(simulation:), it first says what is wrong with that (docs/own_simulation.md).
Exit status: 0 done; 1 the data cannot support an answer, cancelled, or an internal error; 2 wrong
usage or configuration, or a file that cannot be read or written.)";
  program.options.add_options()  //
      ("config", po::value<std::string>()->value_name("FILE"),
       "configuration (YAML); config/reference.yaml explains every key; without it every default "
       "is taken, and input and output by their names (inspect shows them)")  //
      ("output", po::value<std::string>()->required()->value_name("FILE"),
       "where the explanation goes (JSON)")  //
      ("validation", po::value<std::vector<std::string>>()->composing()->value_name("DATA"),
       "data used only to measure the gain, in place of a share of DATA; may be repeated")  //
      ("write-extended", po::value<std::string>()->default_value("")->value_name("FOLDER"),
       "where your simulation goes with all that it lacks: as JSON, and as Python and C++ that run "
       "it and check themselves");
  program.arguments = "data";
  program.run = run;
  return ui::runProgram(program, argc, argv);
}
