#include "io/inspection_yaml.h"

#include <nlohmann/json.hpp>
#include <sstream>

#include "data/text.h"
#include "inspection/suggestion.h"
#include "io/inspection_text.h"
#include "io/printable.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// A name as a quoted text, which YAML and JSON write alike.
std::string quotedName(const std::string& name) {
  if (!isPrintable(name))
    throw DataError("the name '" + printable(name) +
                    "' holds bytes that are no text, so that no configuration can name it; save "
                    "the file in UTF-8");
  return nlohmann::json(name).dump();
}

std::string numberOf(double value) { return nlohmann::json(value).dump(); }

std::string comment(const std::string& text) {
  std::istringstream lines(text);
  std::string commented;
  for (std::string line; std::getline(lines, line);) commented += "# " + printable(line) + "\n";
  return commented;
}

std::string signalLine(const std::string& key, const SignalOptions& signal,
                       const SignalOptions& usual, bool is_bag) {
  std::vector<std::string> parts;
  if (!signal.column.empty()) parts.push_back("column: " + quotedName(signal.column));
  if (is_bag) {
    parts.push_back("topic: " + quotedName(signal.topic));
    parts.push_back("field: " + quotedName(signal.field));
  }
  if (signal.scale != usual.scale) parts.push_back("scale: " + numberOf(signal.scale));
  if (signal.offset != usual.offset) parts.push_back("offset: " + numberOf(signal.offset));
  if (parts.empty())
    return "# " + key + ": {}   # the column " + (key == "input" ? "u" : "y") + "\n";
  std::string line = key + ": {";
  for (std::size_t i = 0; i < parts.size(); ++i) line += (i == 0 ? "" : ", ") + parts[i];
  return line + "}\n";
}

std::string timeLine(const Survey& survey, const TimeOptions& time) {
  if (survey.times.empty()) return "";
  if (survey.times.size() > 1)
    return "# The files name their time differently; each is read by its own names.\n";
  std::string line = "time: {";
  if (!time.column.empty()) line += "column: " + quotedName(time.column) + ", ";
  line += "unit: " + nameOf(time.unit);
  if (time.counts()) line += ", sample_time: " + numberOf(time.sample_time);
  line += "}";
  if (survey.times.front().assumed)
    line += "   # taken for seconds; otherwise ms, us, ns, min, h or d";
  if (time.counts()) line += "   # the rows are counted: write the real sample time [s] here";
  return line + "\n";
}

std::string experimentLine(const ExperimentOptions& experiment) {
  std::string line = "experiment: {mode: " + nameOf(experiment.mode);
  const bool has_topic =
      experiment.mode == ExperimentMode::topic || experiment.mode == ExperimentMode::message;
  if (has_topic && experiment.topic != ExperimentOptions().topic)
    line += ", topic: " + quotedName(experiment.topic);
  if (experiment.mode == ExperimentMode::duration)
    line += ", duration: " + numberOf(experiment.duration);
  if (experiment.mode == ExperimentMode::gap) line += ", gap: " + numberOf(experiment.gap);
  if (!experiment.column.empty()) line += ", column: " + quotedName(experiment.column);
  return line + "}\n";
}

/// Channels beside input and output that move, as covariates that can be switched on.
std::string covariateLines(const InspectedData& data) {
  const SignalPair& pair = *data.choice.chosen;
  std::string lines;
  for (std::size_t i = 0; i < data.survey.channels.size(); ++i) {
    const Channel& channel = data.survey.channels[i];
    if (i == pair.input || i == pair.output || channel.column.empty()) continue;
    if (data.measures[i].shape == SignalShape::constant || !isPrintable(channel.column)) continue;
    const std::string name = quotedName(channel.column);
    lines += (lines.empty() ? "# covariates:\n" : "") + std::string("#   - {name: ") + name +
             ", column: " + name + "}\n";
  }
  const bool by_name =
      !data.configuration.input.column.empty() || !data.configuration.output.column.empty();
  if (lines.empty() || !by_name) return "";
  return "\n# Further signals, in which explain may find a cause:\n" + lines;
}

void requireUsable(const InspectedData& data) {
  if (!data.failure.empty())
    throw DataError("no configuration was written, as it would not work: " + data.failure);
  if (data.loaded.experiments.empty()) {
    std::string reasons;
    for (const RejectedExperiment& each : data.loaded.rejected) reasons += "\n" + each.reason;
    throw DataError("no configuration was written, as no experiment can be used:" + reasons);
  }
  if (!data.choice.chosen && data.configuration.experiment.mode != ExperimentMode::message)
    throw DataError("no configuration was written: " + data.choice.doubt +
                    ", so that there is no input and output");
}

}  // namespace

std::string inspectionYaml(const InspectedData& data) {
  requireUsable(data);
  const Configuration& configuration = data.configuration;
  std::string text =
      "# Written by inspect; works as it is with identify and explain. config/reference.yaml "
      "explains every key.\n\n";
  for (const std::string& sentence : choiceSentences(data)) text += comment(sentence);
  if (configuration.experiment.mode != ExperimentMode::message) {
    const bool is_bag = data.survey.channels[data.choice.chosen->input].column.empty();
    const SignalOptions usual;
    text += signalLine("input", configuration.input, usual, is_bag);
    text += signalLine("output", configuration.output, usual, is_bag);
    text +=
        "# scale: deg in the braces turns degrees into radians; what is kept is scale * value + "
        "offset.\n";
    text += covariateLines(data);
    text += "\n" + timeLine(data.survey, configuration.time);
  }
  text += "\n" + comment("Experiments: " + cutReason(data.survey, configuration) +
                         ". {mode: duration, duration: 10} cuts windows of 10 s.");
  return text + experimentLine(configuration.experiment);
}

}  // namespace uncertainty_identification
