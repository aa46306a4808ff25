#include "io/inspection_tables.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "data/text.h"
#include "inspection/signal_choice.h"
#include "io/printable.h"
#include "io/text_table.h"

namespace uncertainty_identification {
namespace {

using TableRows = std::vector<std::vector<std::string>>;

constexpr std::size_t kMostStreams = 30, kMostSignals = 60, kMostNames = 8;
constexpr double kPerceptibleJitter = 0.02;  // [periods]

/// A value with the digits that tell a range.
std::string fiveDigits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

std::string percent(double share) {
  if (share > 0 && share < 0.001) return "<0.1 %";
  return rounded(100 * share) + " %";
}

std::string rateText(const StampSummary& stamps) {
  if (!(stamps.period > 0)) return "-";
  return stamps.period < 1 ? rounded(1 / stamps.period) + " Hz"
                           : "every " + rounded(stamps.period) + " s";
}

std::string stampText(const StampSummary& stamps) {
  std::vector<std::string> parts;
  const double jitter = stamps.period > 0 ? stamps.jitter / stamps.period : 0;
  if (stamps.period > 0 && !stamps.uniform)
    parts.emplace_back("irregular");
  else if (jitter > kPerceptibleJitter)
    parts.push_back("jitter up to " + rounded(1000 * stamps.jitter) + " ms");
  if (stamps.pauses > 0)
    parts.push_back(std::to_string(stamps.pauses) +
                    (stamps.pauses == 1 ? " pause of " : " pauses, up to ") +
                    rounded(stamps.longest_pause) + " s");
  if (stamps.repeated > 0) parts.push_back(std::to_string(stamps.repeated) + " stamps repeat");
  if (stamps.backward > 0) parts.push_back(std::to_string(stamps.backward) + " stamps go back");
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text.empty() ? "regular" : text;
}

/// "exp_000.csv", or "runs.csv, second" where a file holds several experiments.
std::string streamName(const SurveyedStream& stream) {
  const std::filesystem::path file(stream.file);
  const bool whole = stream.name == file.stem().string();
  return printable(file.filename().string() + (whole ? "" : ", " + stream.name));
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kMostNames, names.size()); ++i)
    text += (i == 0 ? "" : ", ") + printable(names[i]);
  if (names.size() > kMostNames)
    text += " and " + std::to_string(names.size() - kMostNames) + " more";
  return text;
}

std::vector<std::string> stampCells(const StampSummary& stamps) {
  return {std::to_string(stamps.count), rateText(stamps),
          fiveDigits(stamps.end - stamps.start) + " s", stampText(stamps)};
}

void appendCells(const std::vector<std::string>& cells, std::vector<std::string>& row) {
  row.insert(row.end(), cells.begin(), cells.end());
}

std::string fileTable(const std::vector<const SurveyedStream*>& files) {
  TableRows rows{{"file", "rows", "rate", "duration", "stamps", "columns of numbers"}};
  for (std::size_t i = 0; i < std::min(kMostStreams, files.size()); ++i) {
    std::vector<std::string> row{streamName(*files[i])};
    appendCells(stampCells(files[i]->stamps), row);
    row.push_back(i > 0 && files[i]->fields == files[i - 1]->fields ? "the same"
                                                                    : joined(files[i]->fields));
    rows.push_back(row);
  }
  std::string text = textTable(rows);
  if (files.size() > kMostStreams)
    text += "  and " + std::to_string(files.size() - kMostStreams) + " more\n";
  for (const SurveyedStream* file : files)
    if (!file->remark.empty()) text += "  " + printable(file->remark) + "\n";
  return text;
}

std::string topicTable(const std::vector<const SurveyedStream*>& topics) {
  TableRows rows{{"topic", "type", "messages", "rate", "duration", "stamps", "numeric fields"}};
  std::string remarks;
  for (const SurveyedStream* topic : topics) {
    std::vector<std::string> row{printable(topic->name), printable(topic->type)};
    appendCells(stampCells(topic->stamps), row);
    row.push_back(std::to_string(topic->fields.size()));
    rows.push_back(row);
    if (!topic->remark.empty())
      remarks += "  " + printable(topic->name) + ": " + printable(topic->remark) + "\n";
  }
  return textTable(rows) + remarks;
}

std::string rangeText(const SignalMeasures& measures) {
  return fiveDigits(measures.smallest) + " to " + fiveDigits(measures.largest);
}

std::string remarkOf(const Channel& channel, const SignalMeasures& measures) {
  std::string text;
  const auto add = [&text](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  if (measures.clipped && measures.at_largest >= measures.at_smallest)
    add("stays at its largest value for " + percent(measures.at_largest) +
        " of the samples: a limit, or rest?");
  else if (measures.clipped)
    add("stays at its smallest value for " + percent(measures.at_smallest) +
        " of the samples: a limit, or rest?");
  if (channel.empty > 0) add(std::to_string(channel.empty) + " values missing");
  if (channel.not_finite > 0) add(std::to_string(channel.not_finite) + " not finite");
  return text;
}

std::vector<std::string> signalRow(const Channel& channel, const SignalMeasures& measures) {
  const bool has_band = measures.band && measures.shape != SignalShape::constant;
  return {printable(channel.name),
          channel.unit.empty() ? "-" : printable(channel.unit),
          rangeText(measures),
          measures.resolution > 0 ? rounded(measures.resolution) : "-",
          percent(measures.held),
          shapeText(measures),
          has_band ? "below " + rounded(*measures.band) + " Hz" : "-",
          remarkOf(channel, measures)};
}

}  // namespace

std::string streamTables(const Survey& survey) {
  std::vector<const SurveyedStream*> files;
  std::string text;
  for (std::size_t i = 0; i < survey.streams.size(); ++i) {
    const SurveyedStream& stream = survey.streams[i];
    if (stream.type.empty()) {
      files.push_back(&stream);
      continue;
    }
    if (i > 0 && survey.streams[i - 1].file == stream.file) continue;
    std::vector<const SurveyedStream*> topics;
    for (const SurveyedStream& other : survey.streams)
      if (other.file == stream.file && !other.type.empty()) topics.push_back(&other);
    text += (text.empty() ? "" : "\n");
    text += "Topics of " + printable(stream.file) + "\n\n" + topicTable(topics);
  }
  if (files.empty()) return text;
  if (!text.empty()) text += "\n";
  text += "Files of columns";
  if (!survey.times.empty()) {
    const SurveyedTime& time = survey.times.front();
    text += time.column.empty() ? " (no column of time)"
                                : " (time: column '" + printable(time.column) + "' in " +
                                      time.unit + (time.assumed ? ", assumed)" : ")");
  }
  return text + "\n\n" + fileTable(files);
}

std::string signalTable(const Survey& survey, const std::vector<SignalMeasures>& measures) {
  TableRows rows{
      {"signal", "unit", "range", "resolution", "repeats", "shape", "99.5 % of power", "remark"}};
  std::vector<std::string> constant, empty;
  for (std::size_t i = 0; i < survey.channels.size(); ++i) {
    const Channel& channel = survey.channels[i];
    if (measures[i].samples == 0)
      empty.push_back(channel.name);
    else if (measures[i].shape == SignalShape::constant)
      constant.push_back(channel.name + " = " + rounded(measures[i].smallest));
    else if (rows.size() <= kMostSignals)
      rows.push_back(signalRow(channel, measures[i]));
  }
  std::string text = textTable(rows);
  if (!constant.empty())
    text += "  constant (" + std::to_string(constant.size()) + "): " + joined(constant) + "\n";
  if (!empty.empty()) text += "  without a value: " + joined(empty) + "\n";
  return text;
}

std::string experimentTable(const LoadedData& data) {
  if (data.experiments.empty()) return "";
  TableRows rows{{"experiment", "samples", "sample time", "duration", "missing outputs"}};
  for (std::size_t i = 0; i < std::min(kMostStreams, data.experiments.size()); ++i) {
    const Experiment& experiment = data.experiments[i];
    rows.push_back({printable(experiment.id), std::to_string(experiment.samples()),
                    rounded(experiment.sample_time) + " s",
                    fiveDigits(experiment.samples() * experiment.sample_time) + " s",
                    std::to_string(experiment.samples() - experiment.validSamples())});
  }
  std::string text = textTable(rows);
  if (data.experiments.size() > kMostStreams)
    text += "  and " + std::to_string(data.experiments.size() - kMostStreams) + " more\n";
  return text;
}

}  // namespace uncertainty_identification
