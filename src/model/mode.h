#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

/// The modes that a sum of modes (modal.h) consists of, sampled by a zero-order hold.
namespace uncertainty_identification {

/// A mode as a fraction in q^-1: `numerator` begins at q^-1, `denominator` is monic. The columns of
/// the derivatives are those of its parameters.
struct Mode {
  Eigen::VectorXd numerator, denominator;
  Eigen::MatrixXd numerator_derivatives, denominator_derivatives;
};

/// Of a real pole, by tau and residue; of a pair, by omega, zeta, amplitude and phase.
Mode realMode(const double* theta, double sample_time);
Mode pairMode(const double* theta, double sample_time);

/// The poles of a sampled plant as a modal model of given numbers of real poles and pairs has them.
/// Real poles that are too many become pairs, and the other way round.
struct ModalPoles {
  std::vector<double> time_constants;  ///< [s] descending
  std::vector<std::complex<double>>
      pairs;  ///< [rad/s] by increasing frequency, imaginary part positive
};

ModalPoles modalPoles(const Eigen::VectorXd& a, double sample_time, std::size_t reals,
                      std::size_t pairs);

}  // namespace uncertainty_identification
