#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace uncertainty_identification {

/// Poles of a sampled model converted to continuous time. They serve one after the other as
/// starting values of the continuous parameters.
struct ContinuousPoles {
  std::vector<double> time_constants;  ///< [s] of the real poles, descending
  std::vector<std::complex<double>>
      pairs;           ///< [rad/s] of each pair the pole with positive imaginary part
  double longest = 0;  ///< [s] start value when all poles have been used
  std::size_t used_real = 0, used_pairs = 0;

  double nextTimeConstant() {
    const std::size_t k = used_real++;
    return k < time_constants.size() ? time_constants[k] : longest / (1.0 + static_cast<double>(k));
  }

  std::complex<double> pair() const {
    return used_pairs < pairs.size() ? pairs[used_pairs] : std::complex<double>(-1, 1) / longest;
  }
};

/// The poles of 1/A, A = 1 + a1 q^-1 + ..., for samples every `sample_time` [s].
ContinuousPoles continuousPoles(const Eigen::VectorXd& a, double sample_time);

}  // namespace uncertainty_identification
