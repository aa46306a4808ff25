#include "io/inspection_html.h"

#include <algorithm>
#include <cstdio>

#include "data/text.h"
#include "io/inspection_text.h"
#include "io/printable.h"

namespace uncertainty_identification {
namespace {

constexpr double kPictureWidth = 720, kPictureHeight = 90;  // [px] of one signal's picture
constexpr int kColumns = 360;              // points of a picture: smallest and largest of each
constexpr std::size_t kMostPictures = 24;  // experiments that are drawn

const char* const kHead = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>What is in the data</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>
body { font-family: sans-serif; margin: 1.5em auto; max-width: 75em; padding: 0 1em; color: #222; }
pre { overflow-x: auto; background: #f6f6f6; padding: 1em; font-size: 85%; }
svg { width: 100%; max-width: 60em; height: auto; display: block; background: #fafafa; }
polyline { fill: none; stroke-width: 1; } .u { stroke: #b35900; } .y { stroke: #0b62a4; }
rect { fill: #0b62a4; fill-opacity: 0.08; stroke: #0b62a4; stroke-opacity: 0.5; }
text { font-size: 11px; fill: #444; }
</style></head><body>
<h1>What is in the data</h1>
)";

std::string escaped(const std::string& text) {
  std::string html;
  for (const char c : text) {
    if (c == '&')
      html += "&amp;";
    else if (c == '<')
      html += "&lt;";
    else
      html += c;
  }
  return html;
}

std::string pixels(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

/// The values of one signal over time, one after the other.
struct DrawnSignal {
  std::vector<double> times, values;
  std::string name, style;  ///< style: u or y
};

/// Smallest and largest value in each column of the picture, so that no peak is lost.
std::string polyline(const DrawnSignal& signal, double start, double end) {
  const auto extremes = std::minmax_element(signal.values.begin(), signal.values.end());
  const double low = *extremes.first, high = *extremes.second;
  const double range = high > low ? high - low : 1, span = end > start ? end - start : 1;
  const auto point = [&](std::size_t i) {
    const double x = kPictureWidth * (signal.times[i] - start) / span;
    const double y = 4 + (kPictureHeight - 8) * (1 - (signal.values[i] - low) / range);
    return pixels(x) + "," + pixels(y) + " ";
  };
  std::string points;
  const std::size_t count = signal.values.size();
  const std::size_t each = std::max<std::size_t>(1, count / kColumns);
  for (std::size_t begin = 0; begin < count; begin += each) {
    const auto first = signal.values.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last =
        signal.values.begin() + static_cast<std::ptrdiff_t>(std::min(count, begin + each));
    const auto [smallest, largest] = std::minmax_element(first, last);
    const auto places = std::minmax(smallest, largest);
    points += point(static_cast<std::size_t>(places.first - signal.values.begin()));
    if (places.first != places.second)
      points += point(static_cast<std::size_t>(places.second - signal.values.begin()));
  }
  return "<polyline class=\"" + signal.style + "\" points=\"" + points +
         "\"/><text x=\"4\" y=\"12\">" + escaped(printable(signal.name)) + ": " + rounded(low) +
         " to " + rounded(high) + "</text>\n";
}

/// One above the other, with marks behind them.
std::string picture(const std::vector<DrawnSignal>& signals, double start, double end,
                    const std::string& marks) {
  std::string svg = "<svg viewBox=\"0 0 " + pixels(kPictureWidth) + " " +
                    pixels(kPictureHeight * static_cast<double>(signals.size())) +
                    "\" role=\"img\" aria-label=\"input and output over time\">\n" + marks;
  double top = 0;
  for (const DrawnSignal& signal : signals) {
    if (signal.values.empty()) continue;
    svg += "<g transform=\"translate(0 " + pixels(top) + ")\">" + polyline(signal, start, end) +
           "</g>\n";
    top += kPictureHeight;
  }
  return svg + "</svg>\n";
}

std::string experimentPicture(const Experiment& experiment) {
  DrawnSignal u{{}, {}, "u", "u"}, y{{}, {}, "y", "y"};
  for (int k = 0; k < experiment.samples(); ++k) {
    const double time = k * experiment.sample_time;
    u.times.push_back(time);
    u.values.push_back(experiment.u[k]);
    if (!experiment.isValid(k)) continue;
    y.times.push_back(time);
    y.values.push_back(experiment.y[k]);
  }
  const double duration = experiment.samples() * experiment.sample_time;
  return "<h3>" + escaped(printable(experiment.id)) + ", " + rounded(duration) + " s</h3>\n" +
         picture({u, y}, 0, duration, "");
}

/// The only record with the experiments that were cut from it; empty where there are several.
std::string recordPicture(const InspectedData& data) {
  if (data.survey.records != 1 || !data.choice.chosen || data.loaded.experiments.empty()) return "";
  std::vector<DrawnSignal> signals;
  for (const std::size_t place : {data.choice.chosen->input, data.choice.chosen->output}) {
    const Channel& channel = data.survey.channels[place];
    const StampedSignal& record = channel.records.front();
    if (record.stamps.empty()) return "";
    signals.push_back({record.stamps, record.values, channel.name, signals.empty() ? "u" : "y"});
  }
  const double start = std::min(signals[0].times.front(), signals[1].times.front());
  const double end = std::max(signals[0].times.back(), signals[1].times.back());
  std::string marks;
  for (const Experiment& experiment : data.loaded.experiments) {
    const double scale = kPictureWidth / std::max(end - start, 1e-9);
    marks += "<rect x=\"" + pixels((experiment.start_time - start) * scale) +
             "\" y=\"0\" width=\"" + pixels(experiment.samples() * experiment.sample_time * scale) +
             "\" height=\"" + pixels(2 * kPictureHeight) + "\"/>\n";
  }
  return "<h2>Where the record is cut</h2>\n" + picture(signals, start, end, marks);
}

}  // namespace

std::string inspectionHtml(const InspectedData& data) {
  std::string page = kHead;
  page += "<pre>" + escaped(inspectionText(data)) + "</pre>\n" + recordPicture(data);
  const auto& experiments = data.loaded.experiments;
  if (!experiments.empty()) page += "<h2>Experiments</h2>\n";
  for (std::size_t i = 0; i < std::min(kMostPictures, experiments.size()); ++i)
    page += experimentPicture(experiments[i]);
  if (experiments.size() > kMostPictures)
    page += "<p>and " + std::to_string(experiments.size() - kMostPictures) + " more</p>\n";
  return page + "</body></html>\n";
}

}  // namespace uncertainty_identification
