#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "uncertainty_identification/bounds/plant_distribution.h"

namespace uncertainty_identification {

/// (n0 + n1 q^-1 + ...)/(d0 + d1 q^-1 + ...): a controller or a weight.
struct RationalFunction {
  Eigen::VectorXd num = Eigen::VectorXd::Ones(1), den = Eigen::VectorXd::Ones(1);
};

/// Checks that the polynomials describe a controller that can run: finite coefficients, num not
/// zero, d0 not 0 (otherwise the output would precede the input), no pole outside the unit circle.
/// Poles on the unit circle are allowed, because integrators have them; the tolerance is 1e-6,
/// because multiple roots can be computed only to that accuracy. The margin of an unstable
/// controller could be computed, but such a controller diverges when its loop is opened or its
/// actuator saturates, and nearly always a sign is wrong. Throws ConfigurationError, whose message
/// begins with `key`.
void requireController(const RationalFunction& controller, const std::string& key = "controller");

/// The controller to be analysed, and the settings of the analysis.
struct RobustMarginOptions {
  RationalFunction controller{Eigen::VectorXd(), Eigen::VectorXd()};  ///< required
  double minimum_margin =
      1;                ///< smaller margins count as lost; 1 to 1000, more than 1 keeps a reserve
  int samples = 10000;  ///< number of plants drawn, 100 to 1000000
  std::uint64_t seed = 1;

  /// Throws ConfigurationError that names the key, the value and the allowed range.
  void validate() const;
};

/// Robustness of the loop u = K (r - y), y = G u, G = Go (1 + W Delta).
struct RobustMargin {
  bool nominal_stable = false;  ///< of the loop with Go; if false, peak and margin mean nothing
  double peak = 0;              ///< max over frequency of |W T|, T = Go K/(1 + Go K)
  double peak_omega = 0;        ///< [rad/s] frequency of the peak
  double margin =
      0;  ///< 1/peak: W may grow by this factor; 0 if not nominal_stable, infinite if W T = 0
  /// Share of the drawn plants with which the loop is unstable.
  double unstable_probability = 0;
  double unstable_error = 0;  ///< its Monte Carlo standard error
  double unstable_upper =
      0;  ///< 95 % upper limit (Clopper and Pearson); above 0 even if no draw is unstable
  int samples = 0;
  Uncertainty uncertainty = Uncertainty::mixture;  ///< which uncertainty the draws contain

  /// Whether the loop is stable with every plant that W covers (small-gain theorem).
  bool robust() const { return nominal_stable && peak < 1; }
};

/// The margin of the controller for Go with the uncertainty W, and the probability of instability
/// estimated from draws of the plant, including the estimation errors where these are known. Throws
/// ConfigurationError as validate() does, or if controller and plant form an algebraic loop without
/// a solution; DataError if W is not stable or not finite.
RobustMargin robustMargin(const PlantDistribution& plants, const RationalFunction& weight,
                          const RobustMarginOptions& options);

/// Characteristic polynomials of the loop with each plant, one per row, without the leading 1. The
/// loop is stable if all roots lie inside the unit circle (isStable()). Throws ConfigurationError
/// if the leading coefficient vanishes (an algebraic loop).
Eigen::MatrixXd characteristicPolynomials(const PlantSamples& plants,
                                          const RationalFunction& controller);

}  // namespace uncertainty_identification
