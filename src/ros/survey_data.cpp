#include "ros/survey_data.h"

#include <algorithm>

#include "data/experiment_checks.h"
#include "inspection/suggestion.h"
#include "io/csv_header.h"
#include "io/csv_survey.h"
#include "io/inspection_text.h"
#include "ros/bag_survey.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/ros/load_data.h"

namespace uncertainty_identification {
namespace {

bool isBag(const std::string& path) {
  return path.size() > 4 && path.compare(path.size() - 4, 4, ".bag") == 0;
}

std::string absolute(const std::string& topic) {
  return topic.empty() || topic.front() == '/' ? topic : "/" + topic;
}

/// Whether a field is meant by the path in a configuration, which may begin with another name.
bool isMeant(const std::string& field, const std::string& path) {
  if (field == path || path == "auto") return true;
  return path.size() > field.size() && path[path.size() - field.size() - 1] == '.' &&
         path.compare(path.size() - field.size(), field.size(), field) == 0;
}

/// The channel that the configuration names; nothing where it names none that the data hold.
std::optional<std::size_t> givenChannel(const Survey& survey, const SignalOptions& signal) {
  for (std::size_t i = 0; i < survey.channels.size(); ++i) {
    const Channel& channel = survey.channels[i];
    const bool by_column = !channel.column.empty() && channel.column == signal.column;
    const bool by_field =
        !channel.topic.empty() && channel.topic == absolute(signal.topic) &&
        (isMeant(channel.field, signal.field) ||
         (!channel.numbered_field.empty() && isMeant(channel.numbered_field, signal.field)));
    if (by_column || by_field) return i;
  }
  return std::nullopt;
}

/// What a configuration states of a signal stays as it is.
void keepStated(const SignalOptions& stated, const SignalOptions& usual, SignalOptions& signal) {
  const bool is_stated =
      !stated.column.empty() || stated.topic != usual.topic || stated.field != usual.field;
  if (is_stated) signal = stated;
}

/// What cannot be used for a fit moves from the experiments to the rejected ones.
void rejectDefects(const Configuration& configuration, LoadedData& data) {
  const CheckReport report =
      checkExperiments(data.experiments, configuration.limits, {}, configuration.sample_time);
  std::vector<Experiment> usable;
  for (const int r : report.usable)
    usable.push_back(std::move(data.experiments[static_cast<std::size_t>(r)]));
  data.experiments = std::move(usable);
  data.rejected.insert(data.rejected.end(), report.rejected.begin(), report.rejected.end());
  data.warnings.insert(data.warnings.end(), report.warnings.begin(), report.warnings.end());
}

void readExperiments(const std::vector<std::string>& paths, InspectedData& data) {
  try {
    data.configuration.validate();
    data.loaded = loadData(paths, data.configuration);
    rejectDefects(data.configuration, data.loaded);
  } catch (const Error& error) {
    data.failure = error.what();
  }
}

/// The survey with its measures, and the signals that are chosen.
InspectedData chosenSignals(const std::vector<std::string>& paths,
                            const Configuration& configuration, bool given) {
  InspectedData data;
  data.survey = surveyData(paths, configuration);
  for (const Channel& channel : data.survey.channels) data.measures.push_back(measure(channel));
  GivenSignals signals;
  if (given) {
    signals.input = givenChannel(data.survey, configuration.input);
    signals.output = givenChannel(data.survey, configuration.output);
  }
  data.choice = chooseSignals(data.survey, data.measures, signals);
  data.configuration = suggestedConfiguration(data.survey, data.choice, configuration);
  keepStated(configuration.input, Configuration().input, data.configuration.input);
  keepStated(configuration.output, Configuration().output, data.configuration.output);
  return data;
}

}  // namespace

Survey surveyData(const std::vector<std::string>& paths, const Configuration& configuration) {
  Survey all;
  for (const std::string& file : dataFiles(paths)) {
    try {
      append(isBag(file) ? surveyBag(file) : surveyCsv(file, configuration), all);
    } catch (const FileError& error) {
      all.remarks.emplace_back(error.what());
    }
  }
  if (!all.streams.empty()) return all;
  std::string message = "nothing could be read";
  for (const std::string& remark : all.remarks) message += "\n" + remark;
  throw FileError(message);
}

InspectedData inspectData(const std::vector<std::string>& paths, const Configuration& configuration,
                          bool given) {
  InspectedData data = chosenSignals(paths, configuration, given);
  readExperiments(paths, data);
  return data;
}

bool readsByItself(const std::vector<std::string>& paths) {
  for (const std::string& file : dataFiles(paths)) {
    if (isBag(file)) return false;
    try {
      CsvLines lines(file);
      chooseColumns(readHead(file, lines).header, {});
    } catch (const Error&) {
      return false;
    }
  }
  return true;
}

Configuration configurationByNames(const std::vector<std::string>& paths, std::string& told) {
  if (readsByItself(paths)) return {};
  const InspectedData data = chosenSignals(paths, {}, false);
  if (data.configuration.experiment.mode == ExperimentMode::message) return data.configuration;
  const std::string& doubt = data.choice.doubt;
  if (!doubt.empty() || !data.choice.chosen)
    throw ConfigurationError(
        "no --config was given, and input and output cannot be told from the "
        "names: " +
        doubt +
        "; 'inspect DATA...' shows what is in the data, and 'inspect --write "
        "C.yaml DATA...' writes a configuration to start from");
  told = chosenText(data);
  return data.configuration;
}

}  // namespace uncertainty_identification
