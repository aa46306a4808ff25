#pragma once

#include <functional>
#include <random>

#include "curves/starts.h"
#include "curves/window_fit.h"

namespace uncertainty_identification {

/// The plant.
constexpr double kPole = 0.8, kGain = 0.3;

/// Windows of y(k+1) = p y(k) + 0.3 u(k), each of a record of its own and from another initial
/// state, in white noise; p is poleOf(window).
inline SimulationData firstOrderWindows(
    int windows, int samples, double noise, unsigned seed,
    const std::function<double(int)>& poleOf = [](int) { return kPole; }) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  SimulationData data;
  data.sample_time = 1;
  for (int w = 0; w < windows; ++w) {
    SimulationWindow window;
    window.record = w;
    window.u.resize(samples);
    window.y.resize(samples);
    double x = 2 * normal(engine);
    for (int k = 0; k < samples; ++k) {
      window.u[k] = normal(engine);
      window.y[k] = x + noise * normal(engine);
      x = poleOf(w) * x + kGain * window.u[k];
    }
    window.plays = playsOf(window.u);
    window.measured = Eigen::ArrayXd::Ones(samples);
    window.time = Eigen::VectorXd::LinSpaced(samples, 0, 1);
    data.windows.push_back(window);
    data.groups.push_back(w);
  }
  data.groups.push_back(windows);
  data.longest = samples;
  data.samples = windows * samples;
  return data;
}

inline WindowFit fitted(const SimulationData& data) {
  return fitFreely(data, linearStart(data, 1, false, 0), {});
}

}  // namespace uncertainty_identification
