#include "inspection/survey.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/sample_grid.h"

namespace uncertainty_identification {
namespace {

constexpr double kPausePeriods = 20;  // a longer silence is a pause, as it divides a file

bool sameTime(const SurveyedTime& left, const SurveyedTime& right) {
  return left.column == right.column && left.unit == right.unit &&
         left.experiments == right.experiments;
}

Channel& channelLike(const Channel& other, Survey& all) {
  const auto found =
      std::find_if(all.channels.begin(), all.channels.end(), [&](const Channel& channel) {
        return channel.name == other.name && channel.column == other.column;
      });
  if (found != all.channels.end()) return *found;
  all.channels.push_back({other.name, other.column, other.topic, other.field, other.unit});
  all.channels.back().numbered_field = other.numbered_field;
  return all.channels.back();
}

}  // namespace

StampSummary summaryOf(const std::vector<double>& stamps) {
  StampSummary summary;
  summary.count = static_cast<long>(stamps.size());
  std::vector<double> rising;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    if (i > 0 && stamps[i] == stamps[i - 1]) ++summary.repeated;
    if (i > 0 && stamps[i] < stamps[i - 1]) ++summary.backward;
    if (std::isfinite(stamps[i]) && (rising.empty() || stamps[i] > rising.back()))
      rising.push_back(stamps[i]);
  }
  if (rising.empty()) return summary;
  summary.start = rising.front();
  summary.end = rising.back();
  if (rising.size() < 2) return summary;
  const SampleGrid grid = fitSampleGrid(rising);
  summary.period = grid.period;
  summary.jitter = grid.max_departure;
  summary.uniform = grid.one_to_one;
  for (std::size_t i = 1; i < rising.size(); ++i) {
    const double step = rising[i] - rising[i - 1];
    if (step <= kPausePeriods * grid.period) continue;
    ++summary.pauses;
    summary.longest_pause = std::max(summary.longest_pause, step);
  }
  return summary;
}

void append(Survey more, Survey& all) {
  for (Channel& channel : more.channels) {
    Channel& into = channelLike(channel, all);
    into.records.resize(all.records);
    std::move(channel.records.begin(), channel.records.end(), std::back_inserter(into.records));
    into.not_finite += channel.not_finite;
    into.empty += channel.empty;
  }
  all.records += more.records;
  for (Channel& channel : all.channels) channel.records.resize(all.records);
  std::move(more.streams.begin(), more.streams.end(), std::back_inserter(all.streams));
  for (const SurveyedTime& time : more.times)
    if (std::none_of(all.times.begin(), all.times.end(),
                     [&](const auto& known) { return sameTime(known, time); }))
      all.times.push_back(time);
  for (const std::string& remark : more.remarks)
    if (std::find(all.remarks.begin(), all.remarks.end(), remark) == all.remarks.end())
      all.remarks.push_back(remark);
}

}  // namespace uncertainty_identification
