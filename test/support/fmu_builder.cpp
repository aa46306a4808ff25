#include "support/fmu_builder.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "support/process.h"
#include "support/temporary_folder.h"

namespace uncertainty_identification::test {
namespace {

namespace fs = std::filesystem;

void requireSuccess(const std::vector<std::string>& command) {
  const ProcessResult result = runProcess(command);
  if (result.status != 0) throw std::runtime_error(command[0] + ": " + result.errors);
}

void writeEntry(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

/// Entries as `name=file`, so that a name may be any.
const char* const kPack =
    "import sys, zipfile\n"
    "archive = zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED)\n"
    "for each in sys.argv[2:]:\n"
    "    name, file = each.split('=', 1)\n"
    "    archive.writestr(zipfile.ZipInfo(name), open(file, 'rb').read(), zipfile.ZIP_DEFLATED)\n"
    "archive.close()\n";

std::string variableOf(const std::string& interface, int reference, const std::string& name,
                       const std::string& rest, const std::string& number) {
  const std::string head =
      "name=\"" + name + "\" valueReference=\"" + std::to_string(reference) + "\" " + rest;
  if (interface == "CO_SIMULATION_3") return "<Float64 " + head + " " + number + "/>\n";
  return "<ScalarVariable " + head + "><Real " + number + "/></ScalarVariable>\n";
}

}  // namespace

std::string motorDescription(const std::string& interface) {
  const bool is_third = interface == "CO_SIMULATION_3";
  const std::string parameter = "causality=\"parameter\" variability=\"fixed\"";
  const auto variable = [&](int reference, const std::string& name, const std::string& rest,
                            const std::string& number) {
    return variableOf(interface, reference, name, rest, number);
  };
  const std::string kind = interface == "MODEL_EXCHANGE_2" ? "ModelExchange" : "CoSimulation";
  return std::string("<?xml version=\"1.0\"?>\n<fmiModelDescription modelName=\"motor\" ") +
         (is_third ? "fmiVersion=\"3.0\" instantiationToken" : "fmiVersion=\"2.0\" guid") +
         "=\"{motor}\" numberOfEventIndicators=\"1\">\n<" + kind +
         " modelIdentifier=\"motor\"/>\n<TypeDefinitions>" +
         (is_third ? "<Float64Type name=\"Inertia\" unit=\"kg m2\"/>"
                   : "<SimpleType name=\"Inertia\"><Real unit=\"kg m2\"/></SimpleType>") +
         "</TypeDefinitions>\n<ModelVariables>\n" +
         variable(0, "voltage", "causality=\"input\"", "start=\"0\" unit=\"V\"") +
         variable(1, "speed", "causality=\"output\"", "unit=\"rad/s\"") +
         variable(2, "inertia", parameter, "start=\"0.02\" declaredType=\"Inertia\"") +
         variable(3, "constant", parameter, "start=\"0.5\"") +
         variable(4, "damping", parameter, "start=\"0.1\"") +
         variable(5, "friction", parameter, "start=\"0.15\" unit=\"N m\"") +
         "</ModelVariables>\n<ModelStructure><Derivatives><Unknown index=\"2\"/></Derivatives>"
         "</ModelStructure>\n</fmiModelDescription>\n";
}

void buildFmu(const std::string& path, const FmuRecipe& recipe) {
  const TemporaryFolder folder;
  const bool is_third = recipe.interface == "CO_SIMULATION_3";
  const std::string library = folder / "motor.so";
  std::vector<std::string> compile{
      "/usr/bin/env", "cc",    "-std=c11", "-D_GNU_SOURCE", "-O1",
      "-shared",      "-fPIC", "-o",       library,         "-D" + recipe.interface};
  for (const std::string& each : recipe.defines) compile.push_back("-D" + each);
  compile.push_back(std::string(TEST_DATA) + "/fmu/motor.c");
  compile.push_back("-lm");
  requireSuccess(compile);
  std::map<std::string, std::string> entries = recipe.more;
  entries.emplace("modelDescription.xml", recipe.description.empty()
                                              ? motorDescription(recipe.interface)
                                              : recipe.description);
  std::vector<std::string> pack{"/usr/bin/env", "python3", "-c", kPack, path};
  int count = 0;
  for (const auto& [name, text] : entries) {
    const std::string file = folder / ("entry" + std::to_string(count++));
    writeEntry(file, text);
    const auto& none = recipe.without;
    if (std::find(none.begin(), none.end(), name) == none.end()) pack.push_back(name + "=" + file);
  }
#if defined(__aarch64__)
  const std::string platform = "aarch64-linux";
#else
  const std::string platform = is_third ? "x86_64-linux" : "linux64";
#endif
  const std::string name = "binaries/" + platform + "/motor.so";
  if (std::find(recipe.without.begin(), recipe.without.end(), name) == recipe.without.end())
    pack.push_back(name + "=" + library);
  requireSuccess(pack);
}

}  // namespace uncertainty_identification::test
