#include "curves/simulation_data.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace uncertainty_identification {

Eigen::MatrixXd playsOf(const Eigen::VectorXd& u) {
  Eigen::MatrixXd plays(u.size(), kPlays);
  for (int p = 0; p < kPlays; ++p) {
    const double width = kPlayWidths[static_cast<std::size_t>(p)];
    double held = u[0];
    for (Eigen::Index k = 0; k < u.size(); ++k)
      plays(k, p) = held = std::min(std::max(held, u[k] - width), u[k] + width);
  }
  return plays;
}

Scale scaleOf(double sum, double squares, double count, bool remove_mean) {
  const double mean = sum / std::max(count, 1.0);
  const double deviation =
      std::sqrt(std::max(squares / std::max(count, 1.0) - mean * mean, 0.0)) + 1e-12;
  return {remove_mean || std::abs(mean) > 3 * deviation ? mean : 0.0, deviation};
}

std::vector<std::vector<int>> windowsByRecord(const SimulationData& data) {
  std::map<int, std::vector<int>> by_record;
  for (std::size_t w = 0; w < data.windows.size(); ++w)
    by_record[data.windows[w].record].push_back(static_cast<int>(w));
  std::vector<std::vector<int>> windows;
  windows.reserve(by_record.size());
  for (auto& [record, of_record] : by_record) windows.push_back(std::move(of_record));
  return windows;
}

SimulationData onlyOf(const SimulationData& data, const std::vector<int>& windows) {
  SimulationData record;
  record.scales = data.scales;
  record.sample_time = data.sample_time;
  record.own_levels = data.own_levels;
  for (const int w : windows) {
    record.groups.push_back(static_cast<int>(record.windows.size()));
    record.windows.push_back(data.windows[static_cast<std::size_t>(w)]);
    record.longest = std::max(record.longest, record.windows.back().samples());
    record.samples += record.windows.back().measuredSamples();
  }
  record.groups.push_back(static_cast<int>(record.windows.size()));
  return record;
}

int changesOf(const Eigen::VectorXd& signal) {
  const Eigen::Index count = signal.size();
  return count < 2
             ? 0
             : static_cast<int>(
                   (signal.tail(count - 1).array() != signal.head(count - 1).array()).count());
}

int reversalsOf(const Eigen::VectorXd& signal, double least) {
  int reversals = 0;
  double highest = signal[0], lowest = signal[0];  // since the last reversal
  int direction = 0;
  for (Eigen::Index k = 0; k < signal.size(); ++k) {
    const double value = signal[k];
    highest = std::max(highest, value);
    lowest = std::min(lowest, value);
    int turned = direction;
    if (direction >= 0 && value < highest - least) turned = -1;
    if (direction <= 0 && value > lowest + least) turned = 1;
    if (turned == direction) continue;
    if (direction != 0) ++reversals;
    direction = turned;
    highest = lowest = value;
  }
  return reversals;
}

}  // namespace uncertainty_identification
