#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace uncertainty_identification::study {

/// A stable linear plant in continuous time, as its physical parameters:
/// gain e^(-dead_time s) / (prod(1 + tau_k s) (1 + 2 damping s/resonance + s^2/resonance^2)).
struct PlantParameters {
  double gain = 1;
  std::vector<double> time_constants;  ///< tau_k [s], all different
  double resonance = 0;                ///< [rad/s]; 0 = there is none
  double damping = 0;                  ///< of the resonance, in (0, 1)
  double dead_time = 0;                ///< [s], not necessarily whole samples
};

/// The plant between the zero-order hold of its input and the sampling of its output. It is exact:
/// the partial fractions r_i/(s - p_i) are discretised one by one, the dead time with its fraction
/// of a sample. Written for the studies alone, so that they share no error with the package.
class SampledPlant {
 public:
  SampledPlant(const PlantParameters& parameters, double sample_time);

  /// The output for an input that was zero before its first sample.
  Eigen::VectorXd simulate(const Eigen::VectorXd& u) const;

  /// G(e^(j omega Ts)), omega in [rad/s].
  Eigen::VectorXcd responses(const Eigen::VectorXd& omega) const;

 private:
  /// x(t+1) = decay x(t) + early u(t - delay) + late u(t - delay - 1); the output is the sum of the
  /// real parts of x.
  struct Term {
    std::complex<double> decay, early, late;
  };

  double sample_time_;
  int delay_;  ///< whole samples of the dead time
  std::vector<Term> terms_;
};

}  // namespace uncertainty_identification::study
