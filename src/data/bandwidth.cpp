#include "data/bandwidth.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace uncertainty_identification {

double bandwidth(const Eigen::VectorXd& signal) {
  const Eigen::Index samples = signal.size();
  Eigen::Index length = 1;
  while (length < samples) length *= 2;
  Eigen::VectorXd windowed = Eigen::VectorXd::Zero(length);
  for (Eigen::Index k = 0; k < samples; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(samples - 1);
    windowed[k] = (signal[k] - signal[0] - (signal[samples - 1] - signal[0]) * share) * 0.5 *
                  (1 - std::cos(2 * M_PI * share));
  }
  Eigen::FFT<double> transform;
  Eigen::VectorXcd spectrum;
  transform.fwd(spectrum, windowed);
  Eigen::ArrayXd power = spectrum.head(length / 2 + 1).array().abs2();
  std::vector<double> top(power.data() + power.size() * 3 / 4, power.data() + power.size());
  std::nth_element(top.begin(), top.begin() + static_cast<std::ptrdiff_t>(top.size() / 2),
                   top.end());
  power = (power - 2 * top[top.size() / 2]).max(0.0);
  const double total = power.sum();
  if (!(total > 0)) return 0.5;
  double sum = 0;
  for (Eigen::Index k = 0; k < power.size(); ++k) {
    sum += power[k];
    if (sum >= 0.995 * total) return static_cast<double>(k) / static_cast<double>(length);
  }
  return 0.5;
}

}  // namespace uncertainty_identification
