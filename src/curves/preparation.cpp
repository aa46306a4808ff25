#include "curves/preparation.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "curves/covariate_signals.h"
#include "data/bridged_output.h"
#include "data/thinning.h"

namespace uncertainty_identification {
namespace {

constexpr double kPerPeriod = 24;  // samples
constexpr int kShortest = 60, kLongest = 400, kWantedWindows = 10;
constexpr std::size_t kManyExperiments = 8;

Eigen::VectorXd scaled(const Eigen::VectorXd& signal, const Scale& scale) {
  return ((signal.array() - scale.offset) / scale.unit).matrix();
}

/// The whole experiment as one window.
SimulationWindow wholeWindow(const Experiment& experiment, const SignalScales& scales) {
  SimulationWindow whole;
  const int samples = experiment.samples();
  whole.u = scaled(experiment.u, scales.u);
  whole.plays = playsOf(whole.u);
  whole.y = scaled(bridgedOutput(experiment), scales.y);
  whole.measured.resize(samples);
  for (int k = 0; k < samples; ++k) whole.measured[k] = experiment.isValid(k) ? 1 : 0;
  whole.time = Eigen::VectorXd::LinSpaced(samples, 0, 1);
  for (const auto& [name, scale] : scales.covariates)
    whole.covariates[name] = scaled(signalOf(scale, experiment), scale);
  return whole;
}

SimulationWindow cut(const SimulationWindow& whole, int begin, int length, double sample_time) {
  SimulationWindow window;
  window.record = whole.record;
  window.start = begin * sample_time;
  window.u = whole.u.segment(begin, length);
  window.plays = whole.plays.middleRows(begin, length);
  window.y = whole.y.segment(begin, length);
  window.measured = whole.measured.segment(begin, length);
  window.time = whole.time.segment(begin, length);
  for (const auto& [name, signal] : whole.covariates)
    window.covariates[name] = signal.segment(begin, length);
  return window;
}

/// The window with `samples` at rest before it.
SimulationWindow withRest(const SimulationWindow& window, const RestingPoint& point, int samples) {
  SimulationWindow longer = window;
  const auto prepended = [samples](const Eigen::VectorXd& signal, double value) -> Eigen::VectorXd {
    Eigen::VectorXd all(samples + signal.size());
    all << Eigen::VectorXd::Constant(samples, value), signal;
    return all;
  };
  longer.rest = samples;
  longer.u = prepended(window.u, point.u);
  longer.y = prepended(window.y, point.y);
  longer.plays = playsOf(longer.u);
  longer.measured = prepended(window.measured.matrix(), 1).array();
  longer.time = prepended(window.time, window.time[0]);
  for (auto& [name, signal] : longer.covariates) signal = prepended(signal, signal[0]);
  return longer;
}

/// Takes every so manieth window, so that at most `most` samples are left.
void keepAtMost(int most, std::vector<SimulationWindow>* windows) {
  int samples = 0;
  for (const SimulationWindow& window : *windows) samples += window.samples();
  if (most == 0 || samples <= most) return;
  const auto each = static_cast<std::size_t>((samples + most - 1) / most);
  std::vector<SimulationWindow> kept;
  for (std::size_t k = 0; k < windows->size(); k += each) kept.push_back(std::move((*windows)[k]));
  *windows = std::move(kept);
}

/// Windows of an experiment are left out together where there are many experiments.
void group(std::size_t experiments, SimulationData* data) {
  data->groups.clear();
  int record = -1;
  for (std::size_t w = 0; w < data->windows.size(); ++w) {
    const SimulationWindow& window = data->windows[w];
    if (experiments < kManyExperiments || window.record != record)
      data->groups.push_back(static_cast<int>(w));
    record = window.record;
    data->longest = std::max(data->longest, window.samples());
    data->samples += window.measuredSamples();
  }
  data->groups.push_back(static_cast<int>(data->windows.size()));
}

struct Lengths {
  int total = 0, longest = 0;  // samples after thinning
};

Lengths lengthsOf(const std::vector<Experiment>& experiments, int thinning) {
  Lengths found;
  for (const Experiment& experiment : experiments) {
    const int samples = experiment.samples() / thinning;
    found.total += samples;
    found.longest = std::max(found.longest, samples);
  }
  return found;
}

int piecesOf(int samples, const WindowPlan& plan) {
  return plan.one_of_each ? 1 : std::max(1, (samples + plan.length / 2) / std::max(plan.length, 1));
}

int countWindows(const std::vector<Experiment>& experiments, const WindowPlan& plan) {
  int count = 0;
  for (const Experiment& experiment : experiments)
    count += piecesOf(experiment.samples() / plan.thinning, plan);
  return count;
}

}  // namespace

WindowPlan planWindows(const std::vector<Experiment>& experiments) {
  WindowPlan plan{1, 0, false, false, RestBefore(experiments)};
  plan.thinning = thinningByBandwidth(experiments, kPerPeriod);
  const Lengths samples = lengthsOf(experiments, plan.thinning);
  plan.one_of_each = experiments.size() >= kManyExperiments && samples.longest <= kLongest;
  const int wanted = std::max(kShortest, samples.total / kWantedWindows);
  plan.length = plan.one_of_each ? samples.longest : std::min({samples.longest, kLongest, wanted});
  return plan;
}

WindowPlan withOtherWindows(const WindowPlan& plan, const std::vector<Experiment>& experiments) {
  constexpr int kEnoughWindows = 8;
  WindowPlan other = plan;
  other.length = plan.length * 3 / 2;
  if (countWindows(experiments, other) < kEnoughWindows) other.length = plan.length * 2 / 3;
  return other;
}

std::optional<WindowPlan> withLongWindows(const WindowPlan& plan,
                                          const std::vector<Experiment>& experiments) {
  if (plan.one_of_each) return {};
  const Lengths samples = lengthsOf(experiments, plan.thinning);
  WindowPlan longer = plan;
  longer.length =
      std::min({samples.longest, kLongest, 2 * plan.length, samples.total / kFewestWindows});
  const bool is_longer = longer.length >= 3 * plan.length / 2;
  if (!is_longer || countWindows(experiments, longer) < kFewestWindows) return {};
  return longer;
}

SignalScales scalesOf(const std::vector<Experiment>& experiments,
                      const std::vector<Experiment>& held, double lag_unit) {
  double count = 0, measured = 0;
  Eigen::Array4d sums = Eigen::Array4d::Zero();
  for (const Experiment& experiment : experiments) {
    count += experiment.samples();
    sums[0] += experiment.u.sum();
    sums[1] += experiment.u.squaredNorm();
    for (int k = 0; k < experiment.samples(); ++k) {
      if (!experiment.isValid(k)) continue;
      measured += 1;
      sums[2] += experiment.y[k];
      sums[3] += experiment.y[k] * experiment.y[k];
    }
  }
  SignalScales scales;
  scales.u = scaleOf(sums[0], sums[1], count, false);
  scales.y = scaleOf(sums[2], sums[3], measured, true);
  scales.covariates = covariateScales(experiments, held, lag_unit);
  return scales;
}

SimulationData windowsOf(const std::vector<Experiment>& experiments, const WindowPlan& plan,
                         const SignalScales& scales, int most) {
  constexpr int kResting = 32;  // samples, as many as an initial state is estimated from
  SimulationData data;
  data.scales = scales;
  data.own_levels = plan.own_levels;
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    const Experiment experiment = thinned(experiments[r], plan.thinning);
    data.sample_time = experiment.sample_time;
    SimulationWindow whole = wholeWindow(experiment, scales);
    whole.record = static_cast<int>(r);
    const int pieces = piecesOf(whole.samples(), plan);
    const int length = whole.samples() / pieces;
    for (int piece = 0; piece < pieces && length > 0; ++piece)
      data.windows.push_back(cut(whole, piece * length, length, data.sample_time));
    const auto rest = plan.rest_before.of(experiments[r]);
    if (!rest || length == 0) continue;
    SimulationWindow& first = data.windows[data.windows.size() - static_cast<std::size_t>(pieces)];
    first = withRest(
        first,
        {(rest->u - scales.u.offset) / scales.u.unit, (rest->y - scales.y.offset) / scales.y.unit},
        std::max(kResting, length / 10));
  }
  keepAtMost(most, &data.windows);
  group(experiments.size(), &data);
  return data;
}

}  // namespace uncertainty_identification
