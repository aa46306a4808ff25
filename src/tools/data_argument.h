#pragma once

#include <algorithm>
#include <boost/program_options.hpp>
#include <string>
#include <vector>

#include "data/text.h"
#include "io/command_line.h"
#include "ros/survey_data.h"
#include "uncertainty_identification/io/configuration_yaml.h"
#include "uncertainty_identification/ros/load_data.h"

namespace uncertainty_identification {

/// The configuration that a command line names; without one that of configurationByNames for DATA,
/// which is told on standard error.
inline Configuration configurationArgument(const boost::program_options::variables_map& arguments,
                                           const std::string& program) {
  if (arguments.count("config") > 0)
    return loadConfiguration(arguments["config"].as<std::string>());
  std::string told;
  const Configuration configuration =
      configurationByNames(arguments["data"].as<std::vector<std::string>>(), told);
  if (!told.empty()) printMessage(program, told);
  return configuration;
}

/// The data that a command line names under this key; nothing where it names none.
inline LoadedData loadDataArgument(const boost::program_options::variables_map& arguments,
                                   const std::string& key, const Configuration& configuration) {
  if (arguments.count(key) == 0) return {};
  return loadData(arguments[key].as<std::vector<std::string>>(), configuration);
}

/// What a command line names to fit to, and for validation.
struct LoadedArguments {
  LoadedData data, validation;
};

/// Experiments of different rates are resampled to the sample time that most of them can have
/// (sampleTimeForAll), unless the configuration states one.
inline LoadedArguments loadArguments(const boost::program_options::variables_map& arguments,
                                     Configuration configuration) {
  const auto load = [&] {
    return LoadedArguments{loadDataArgument(arguments, "data", configuration),
                           loadDataArgument(arguments, "validation", configuration)};
  };
  LoadedArguments loaded = load();
  if (configuration.sample_time > 0) return loaded;
  std::vector<Experiment> all = loaded.data.experiments;
  all.insert(all.end(), loaded.validation.experiments.begin(), loaded.validation.experiments.end());
  configuration.sample_time = sampleTimeForAll(all);
  if (configuration.sample_time == 0) return loaded;
  loaded = load();
  loaded.data.warnings.push_back(
      "the experiments have different sample times; they were resampled to " +
      text(configuration.sample_time) +
      " s, and slower ones, if any, are rejected; sample_time states another");
  return loaded;
}

/// What was noticed while loading. A remark that applies to data and validation alike is made once.
inline void addWarnings(const LoadedData& loaded, std::vector<std::string>* warnings) {
  for (const std::string& text : loaded.warnings)
    if (std::find(warnings->begin(), warnings->end(), text) == warnings->end())
      warnings->push_back(text);
}

/// The files and folders that a command line gives to be read.
inline std::vector<std::string> inputArguments(
    const boost::program_options::variables_map& arguments) {
  std::vector<std::string> inputs;
  if (arguments.count("config") > 0) inputs.push_back(arguments["config"].as<std::string>());
  for (const char* key : {"data", "validation"}) {
    if (arguments.count(key) == 0) continue;
    const auto& named = arguments[key].as<std::vector<std::string>>();
    inputs.insert(inputs.end(), named.begin(), named.end());
  }
  return inputs;
}

}  // namespace uncertainty_identification
