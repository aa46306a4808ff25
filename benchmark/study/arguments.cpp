#include "study/arguments.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification::study {
namespace {

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  std::exit(2);
}

double toNumber(const std::string& name, const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != 0) fail("--" + name + ": found '" + text + "', a number is needed");
  return value;
}

std::string usage(const std::map<std::string, std::string>& allowed) {
  std::string lines = "options:";
  for (const auto& [name, meaning] : allowed) lines += "\n  --" + name + "  " + meaning;
  return lines;
}

}  // namespace

Arguments::Arguments(int argc, char** argv, std::map<std::string, std::string> allowed,
                     const std::vector<std::string>& flags) {
  allowed["jobs"] = "identifications at a time (2)";
  allowed["task-seconds"] =
      "limit of processor time; a longer identification is ended and counts as failed";
  allowed["minutes"] = "no identification is begun after this time";
  allowed["config"] = "YAML file to use instead of the default configuration";
  allowed["orders-auto"] = "choose the orders from the data";
  for (int k = 1; k < argc; ++k) {
    const std::string argument = argv[k];
    const std::string name = argument.rfind("--", 0) == 0 ? argument.substr(2) : "";
    if (name == "help") {
      std::printf("%s\n", usage(allowed).c_str());
      std::exit(0);
    }
    if (allowed.count(name) == 0) fail("'" + argument + "' is not an option\n" + usage(allowed));
    const bool flag =
        name == "orders-auto" || std::find(flags.begin(), flags.end(), name) != flags.end();
    if (!flag && k + 1 == argc) fail("--" + name + " needs a value");
    values_[name] = flag ? "" : argv[++k];
  }
}

std::string Arguments::text(const std::string& name, const std::string& otherwise) const {
  const auto found = values_.find(name);
  return found == values_.end() ? otherwise : found->second;
}

double Arguments::number(const std::string& name, double otherwise) const {
  return has(name) ? toNumber(name, text(name, "")) : otherwise;
}

std::vector<int> Arguments::numbers(const std::string& name, const std::string& otherwise) const {
  const std::string list = text(name, otherwise);
  std::vector<int> values;
  const std::size_t colon = list.find(':');
  if (colon != std::string::npos) {
    const int first = static_cast<int>(toNumber(name, list.substr(0, colon)));
    const int last = static_cast<int>(toNumber(name, list.substr(colon + 1)));
    for (int value = first; value <= last; ++value) values.push_back(value);
    return values;
  }
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    values.push_back(static_cast<int>(toNumber(name, list.substr(begin, end - begin))));
    begin = end + 1;
  }
  return values;
}

TaskLimits Arguments::limits(double minutes) const {
  TaskLimits limits;
  limits.jobs = std::max(1, static_cast<int>(number("jobs", limits.jobs)));
  limits.task_seconds = static_cast<int>(number("task-seconds", limits.task_seconds));
  limits.minutes = number("minutes", minutes);
  return limits;
}

Configuration Arguments::configuration() const {
  Configuration configuration =
      has("config") ? loadConfiguration(text("config", "")) : Configuration();
  if (has("orders-auto")) configuration.nominal_model = NominalModelOptions();
  configuration.estimation.threads = 1;
  return configuration;
}

}  // namespace uncertainty_identification::study
