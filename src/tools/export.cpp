// Writes an identified model for other programs; docs/export.md and --help say how.

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <string>

#include "configuration/require.h"
#include "export/targets.h"
#include "io/atomic_file.h"
#include "io/command_line.h"
#include "io/output_file.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/result_json.h"

namespace {

namespace ui = uncertainty_identification;
namespace po = boost::program_options;

using Target = std::string (*)(const ui::ExportedModel&);

Target targetOf(const std::string& name) {
  static const std::map<std::string, Target> targets{{"mat", ui::matFile},
                                                     {"python", ui::pythonModule},
                                                     {"octave", ui::octaveFunction},
                                                     {"rosparam", ui::rosParameters},
                                                     {"c", ui::cSource}};
  const auto found = targets.find(name);
  if (found == targets.end())
    throw ui::ConfigurationError("--to: found '" + name +
                                 "'; allowed: mat, python, octave, rosparam, c");
  return found->second;
}

/// Octave and MATLAB call a function by the name of its file.
void requireFunctionName(const std::string& target, const std::string& output,
                         const std::string& stem) {
  if (target == "octave" && ui::identifierText(stem) != stem)
    throw ui::ConfigurationError("--output: found '" + output +
                                 "'; allowed for octave: a name of letters, digits and '_' that "
                                 "begins with a letter, as in " +
                                 ui::identifierText(stem) + ".m");
}

void tellWhatIsWritten(const ui::ExportedModel& model, const std::string& target,
                       const std::string& output) {
  std::cout << "Model '" << model.name << "' written to " << output;
  const bool samples = model.samples && target != "rosparam" && target != "c";
  if (samples)
    std::cout << " with " << model.samples->num.rows() << " plants drawn (seed "
              << model.samples_seed << ")";
  std::cout << "\n";
  for (const std::string& missing : model.missing) std::cout << "Not exported: " << missing << "\n";
}

int run(const po::variables_map& arguments) {
  const std::string name = arguments["to"].as<std::string>();
  const Target target = targetOf(name);
  const int count = arguments["count"].as<int>();
  const auto seed = arguments["seed"].as<std::uint64_t>();
  ui::requireRange("--count", count, 1, 1000);
  ui::requireRange<std::uint64_t>("--seed", seed, 0, std::uint64_t{1} << 53);
  const std::string model = arguments["model"].as<std::string>();
  const std::string output = arguments["output"].as<std::string>();
  ui::requireWritable(output, {model});
  const std::string stem = std::filesystem::path(output).stem().string();
  requireFunctionName(name, output, stem);
  const ui::ExportedModel exported =
      ui::exportedModel(ui::loadResult(model), ui::identifierText(stem), count, seed);
  ui::writeFileAtomically(output, target(exported));
  tellWhatIsWritten(exported, name, output);
  return ui::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  ui::Program program;
  program.name = "export";
  program.usage = "--model result.json --to mat|python|octave|rosparam|c --output FILE";
  program.purpose =
      R"(Writes an identified model for other programs: numbers for MATLAB, Octave and Python with plants drawn
from the result, parameters for ROS, or C code of the simulator and the whitening filter (docs/export.md).
The files for Python, Octave and C can compare themselves with numbers that the library computed.
Exit status: 0 done; 1 the result holds no model, or an internal error; 2 wrong usage, or a file that
cannot be read or written.)";
  program.options.add_options()  //
      ("model", po::value<std::string>()->required()->value_name("FILE"),
       "result.json of identify")  //
      ("to", po::value<std::string>()->required()->value_name("TARGET"),
       "mat (MATLAB 5), python (module for numpy), octave (function, MATLAB too), rosparam (YAML), "
       "c "
       "(C99)")  //
      ("output", po::value<std::string>()->required()->value_name("FILE"),
       "where it goes; the model is called by the file's name")  //
      ("count", po::value<int>()->default_value(20)->value_name("N"),
       "number of plants drawn for mat, python and octave, at most 1000")  //
      ("seed", po::value<std::uint64_t>()->default_value(1)->value_name("S"),
       "the same seed draws the same plants");
  program.run = run;
  return ui::runProgram(program, argc, argv);
}
