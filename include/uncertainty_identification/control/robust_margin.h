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

/// Throws ConfigurationError, beginning with `key`, unless the polynomials make a controller that
/// can run: finite coefficients, num not zero, d0 not 0 (else the output precedes the input), no
/// pole outside the unit circle. Poles on it are allowed, as integrators have them (to within 1e-6,
/// because roots that coincide are known to the root of the rounding only). The margin of an
/// unstable controller could be computed; but one that diverges when its loop is opened or its
/// actuator saturates is nearly always a sign gone wrong.
void requireController(const RationalFunction& controller, const std::string& key = "controller");

/// What to judge, and how.
struct RobustMarginOptions {
  RationalFunction controller{Eigen::VectorXd(), Eigen::VectorXd()};  ///< to be given
  double minimum_margin = 1;  ///< below it counts as lost; 1 to 1000: more than 1 is a reserve
  int samples = 10000;        ///< plants drawn, 100 to 1000000
  std::uint64_t seed = 1;

  /// Throws ConfigurationError naming key, value and what is allowed.
  void validate() const;
};

/// How robust a control loop is: u = K (r - y) around y = G u, G = Go (1 + W Delta).
struct RobustMargin {
  bool nominal_stable = false;  ///< the loop with Go; where false, peak and margin mean nothing
  double peak = 0;              ///< max over frequency of |W T|, T = Go K/(1 + Go K)
  double peak_omega = 0;        ///< [rad/s] where
  double margin = 0;            ///< 1/peak: by this factor W may grow before stability can be lost;
                                ///< 0 where the nominal loop is unstable, infinite where W T = 0
  /// Share of the plants that the loop is unstable with, by draws of them.
  double unstable_probability = 0;
  double unstable_error = 0;  ///< its Monte Carlo standard error
  double unstable_upper = 0;  ///< 95 % upper limit (Clopper and Pearson), above 0 also for no draw
  int samples = 0;
  Uncertainty uncertainty = Uncertainty::mixture;  ///< of the draws

  /// Whether the loop is stable with every plant that W covers (small-gain theorem).
  bool robust() const { return nominal_stable && peak < 1; }
};

/// Margin of the controller for the nominal plant with the uncertainty W, and the probability of
/// instability from draws of plants, by the estimate's errors too where these are known. Throws
/// ConfigurationError as validate() does, or where controller and plant have an algebraic
/// loop without a solution; DataError for a W that is not stable or not finite.
RobustMargin robustMargin(const PlantDistribution& plants, const RationalFunction& weight,
                          const RobustMarginOptions& options);

/// Characteristic polynomials of the loop with each plant, without leading 1: one per row. Stable
/// where all roots lie inside the unit circle (isStable()). Throws ConfigurationError where their
/// leading coefficient vanishes: an algebraic loop.
Eigen::MatrixXd characteristicPolynomials(const PlantSamples& plants,
                                          const RationalFunction& controller);

}  // namespace uncertainty_identification
