#include "inspection/suggestion.h"

#include <algorithm>
#include <cmath>

#include "data/text.h"
#include "uncertainty_identification/enum_names.h"

namespace uncertainty_identification {
namespace {

constexpr double kWindows = 10;          // that a record without markers is cut into
constexpr double kFewestInWindow = 100;  // of a window

const SurveyedStream* streamOf(const Survey& survey, bool (*is_wanted)(const std::string&)) {
  const SurveyedStream* found = nullptr;
  for (const SurveyedStream& stream : survey.streams) {
    if (!is_wanted(stream.type)) continue;
    if (found != nullptr && found->name != stream.name) return nullptr;
    found = &stream;
  }
  return found;
}

/// The largest 1, 2 or 5 times a power of ten that is not above `value`.
double roundDown(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= value) return factor * power;
  return power;
}

/// [s] of windows over the records that hold both signals.
double windowFor(const Survey& survey, const SignalPair& pair) {
  double longest = 0, period = 0;
  const Channel &u = survey.channels[pair.input], &y = survey.channels[pair.output];
  for (std::size_t r = 0; r < u.records.size(); ++r) {
    const auto &of_u = u.records[r].stamps, &of_y = y.records[r].stamps;
    if (of_u.empty() || of_y.size() < 2) continue;
    const double length = std::min(of_u.back(), of_y.back()) - std::max(of_u.front(), of_y.front());
    if (length <= longest) continue;
    longest = length;
    period = summaryOf(of_y).period;
  }
  if (!(longest > 0)) return 1;
  const double window = std::max(longest / kWindows, kFewestInWindow * period);
  return window < longest ? roundDown(window) : std::ceil(longest) + 1;
}

void takeTime(const Survey& survey, Configuration& configuration) {
  if (survey.times.size() != 1) return;  // none, or each file has its own
  const SurveyedTime& time = survey.times.front();
  configuration.time.column = time.column;
  if (!configuration.experiment.column.empty() || time.experiments != "experiment")
    configuration.experiment.column = time.experiments;
  for (const auto& [unit, name] : enumNames(TimeUnit()))
    if (time.unit == name && !time.assumed) configuration.time.unit = unit;
  if (time.unit == "index" && !(configuration.time.sample_time > 0))
    configuration.time.sample_time = 1;
}

/// A column that the reader takes by itself is not named: then all other columns are covariates.
void takeChannel(const Channel& channel, const std::string& usual, SignalOptions& signal) {
  if (channel.column != usual || !signal.column.empty()) signal.column = channel.column;
  if (!channel.column.empty()) return;
  signal.topic = channel.topic;
  signal.field = channel.field;
}

void takeCut(const Survey& survey, const SignalPair& pair, ExperimentOptions& experiment) {
  const ExperimentOptions usual;
  if (experiment.mode != usual.mode || experiment.topic != usual.topic) return;  // it is stated
  if (const SurveyedStream* markers = streamOf(survey, isMarkerType)) {
    experiment.topic = markers->name;
    return;
  }
  experiment.mode = ExperimentMode::duration;
  experiment.duration = windowFor(survey, pair);
}

}  // namespace

bool isExperimentType(const std::string& type) {
  return type == "uncertainty_identification/Experiment";
}

bool isMarkerType(const std::string& type) {
  return type == "std_msgs/Bool" || type == "uncertainty_identification/ExperimentMarker";
}

Configuration suggestedConfiguration(const Survey& survey, const SignalChoice& choice,
                                     const Configuration& base) {
  Configuration configuration = base;
  takeTime(survey, configuration);
  if (const SurveyedStream* experiments = streamOf(survey, isExperimentType)) {
    configuration.experiment.mode = ExperimentMode::message;
    configuration.experiment.topic = experiments->name;
    return configuration;
  }
  if (!choice.chosen) return configuration;
  takeChannel(survey.channels[choice.chosen->input], "u", configuration.input);
  takeChannel(survey.channels[choice.chosen->output], "y", configuration.output);
  if (survey.channels[choice.chosen->input].column.empty())
    takeCut(survey, *choice.chosen, configuration.experiment);
  return configuration;
}

std::string cutReason(const Survey& survey, const Configuration& configuration) {
  const ExperimentOptions& experiment = configuration.experiment;
  switch (experiment.mode) {
    case ExperimentMode::message:
      return "the messages on " + experiment.topic + " are whole experiments";
    case ExperimentMode::duration:
      return "windows of " + text(experiment.duration) + " s, one after the other";
    case ExperimentMode::gap:
      return "divided where nothing was recorded for more than " + text(experiment.gap) + " s";
    case ExperimentMode::service:
    case ExperimentMode::topic:
      break;
  }
  const bool columns = !survey.times.empty();
  if (!columns) return "an experiment lasts while " + experiment.topic + " is true";
  const std::string& by = survey.times.front().experiments;
  return (by.empty() ? std::string("each file is one experiment")
                     : "the column '" + by + "' names the experiments") +
         "; divided where the logger paused";
}

}  // namespace uncertainty_identification
