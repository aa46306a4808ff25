#include "inspection/common_records.h"

#include <algorithm>
#include <cmath>

#include "inspection/held_signal.h"

namespace uncertainty_identification {
namespace {

constexpr double kPerPeriod = 10;       // samples a period of the output's bandwidth
constexpr double kMostSamples = 40000;  // of a record

}  // namespace

double ownPeriod(const Channel& channel) {
  std::vector<double> periods;
  for (const StampedSignal& record : channel.records)
    if (record.stamps.size() >= 2) periods.push_back(summaryOf(record.stamps).period);
  if (periods.empty()) return 0;
  std::sort(periods.begin(), periods.end());
  return periods[periods.size() / 2];
}

double periodFor(const Channel& output, double output_band, int lags) {
  const double own = ownPeriod(output);
  if (!(own > 0)) return 0;
  double longest = 0;
  for (const StampedSignal& record : output.records)
    if (record.stamps.size() >= 2)
      longest = std::max(longest, record.stamps.back() - record.stamps.front());
  const double by_band = output_band > 0 ? 1 / (kPerPeriod * output_band) : own;
  const double wanted = std::min(by_band, longest / (10 * lags));  // enough samples are left
  const double thinning =
      std::max(std::floor(wanted / own + 1e-9), std::ceil(longest / own / kMostSamples));
  return own * std::max(1.0, thinning);
}

std::vector<CommonRecord> commonRecords(const Channel& input, const Channel& output, double period,
                                        int order) {
  std::vector<CommonRecord> common;
  for (std::size_t r = 0; r < std::min(input.records.size(), output.records.size()); ++r) {
    const StampedSignal &u = input.records[r], &y = output.records[r];
    if (u.stamps.empty() || y.stamps.empty()) continue;
    const double start = std::max(u.stamps.front(), y.stamps.front());
    const double end = std::min(u.stamps.back(), y.stamps.back());
    const double count = std::min(std::floor((end - start) / period) + 1, kMostSamples);
    if (!(count > 2 * order)) continue;
    const auto samples = static_cast<Eigen::Index>(count);
    common.push_back(
        {heldSignal(u, start, period, samples), heldSignal(y, start, period, samples)});
  }
  return common;
}

}  // namespace uncertainty_identification
