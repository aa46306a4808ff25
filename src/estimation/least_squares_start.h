#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A start for Go found by least squares.
struct LeastSquaresModel {
  Polynomials polynomials;       ///< b, a, delay
  double offset = 0;             ///< constant added to the output
  double residual_variance = 0;  ///< of the last regression
};

/// Rational models by pooled least squares: ARX, refined by the Steiglitz-McBride iteration (ARX on
/// data filtered by 1/A, which tends to output-error least squares). Only a start for
/// the optimisation of the likelihood.
class LeastSquaresStart {
 public:
  /// `experiments` must outlive this object; at most about `max_samples` of their samples are used.
  LeastSquaresStart(const std::vector<const Experiment*>& experiments, bool with_constant,
                    int max_samples = 60000);

  /// ARX(na, nb, delay): A y = q^-delay B u + constant.
  LeastSquaresModel arx(int nb, int na, int delay) const;

  /// Steiglitz-McBride with the delay in [first_delay, last_delay] that leaves least; a longer one
  /// must leave a percent less than a shorter.
  LeastSquaresModel steiglitzMcBride(int nb, int na, int first_delay, int last_delay) const;

 private:
  struct Record {
    Eigen::VectorXd u, y;  ///< gaps of y bridged by interpolation
    std::vector<std::uint8_t> valid;
  };

  /// Triangular factor of the regression on [u lags 0..u_lags, constant, y lags 1..na | y], data
  /// filtered by 1/A.
  Eigen::MatrixXd triangularFactor(const Eigen::VectorXd& prefilter, int na, int u_lags) const;
  LeastSquaresModel leastDelayed(const Eigen::MatrixXd& factor, int nb, int na, int first_delay,
                                 int last_delay) const;
  LeastSquaresModel solve(const Eigen::MatrixXd& factor, int nb, int na, int delay,
                          int u_lags) const;

  std::vector<Record> records_;
  bool with_constant_;
};

/// Noise polynomials C (nc) and D (nd) of residuals v by Hannan and Rissanen's two regressions,
/// made stable and minimum phase.
void hannanRissanen(const std::vector<Eigen::VectorXd>& residuals, int nc, int nd,
                    Eigen::VectorXd* c, Eigen::VectorXd* d);

}  // namespace uncertainty_identification
