#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A starting value for Go found by least squares.
struct LeastSquaresModel {
  Polynomials polynomials;      ///< b, a, delay
  double offset = 0;            ///< constant in the output
  double residual_squares = 0;  ///< of the last regression, summed over its rows
};

/// The constants in the output that a regression estimates beside a model.
enum class Constant {
  none,
  common,  ///< one for all experiments
  of_each  ///< one for each of them, which is eliminated
};

/// That which belongs to a model with these offsets.
Constant constantOf(Offsets offsets);

/// Rational models by least squares pooled over experiments: ARX, refined by the Steiglitz-McBride
/// iteration (ARX on data filtered by 1/A, which approximates output-error least squares). Used
/// only as a start for maximising the likelihood.
class LeastSquaresStart {
 public:
  /// `experiments` must outlive this object. At most about `max_samples` of their samples are used.
  LeastSquaresStart(const std::vector<const Experiment*>& experiments, Constant constant,
                    int max_samples = 60000);

  /// Fits A y = q^-delay B u + constant. A model with constants of each experiment has the offset
  /// 0.
  LeastSquaresModel arx(int nb, int na, int delay) const;

  /// Steiglitz-McBride iteration for each delay in [first_delay, last_delay]. Returns the fit with
  /// the least residual variance; a longer delay is preferred only if it reduces the variance by 1
  /// %. Where experiments do not start at rest, `start` must be unknown; where they do, that leaves
  /// little of a step at the first sample, whose response resembles a free one.
  enum class Start { rest, unknown };
  LeastSquaresModel steiglitzMcBride(int nb, int na, int first_delay, int last_delay,
                                     Start start = Start::rest) const;

  /// The delays that it finds either way: one or two.
  std::vector<int> likelyDelays(int nb, int na, int last_delay) const;

 private:
  struct Record {
    Eigen::VectorXd u, y;  ///< gaps of y bridged by interpolation
    std::vector<std::uint8_t> valid;
  };

  /// Triangular factor of the regression of y on [u lags 0..u_lags, constant, y lags 1..na], data
  /// filtered by 1/A.
  Eigen::MatrixXd triangularFactor(const Eigen::VectorXd& prefilter, int na, int u_lags,
                                   Start start) const;
  LeastSquaresModel leastDelayed(const Eigen::MatrixXd& factor, int nb, int na, int first_delay,
                                 int last_delay) const;
  LeastSquaresModel solve(const Eigen::MatrixXd& factor, int nb, int na, int delay,
                          int u_lags) const;

  std::vector<Record> records_;
  Constant constant_;
};

/// Noise polynomials C (nc) and D (nd) from residuals v, by the two regressions of Hannan and
/// Rissanen. The result is made stable and minimum phase.
void hannanRissanen(const std::vector<Eigen::VectorXd>& residuals, int nc, int nd,
                    Eigen::VectorXd* c, Eigen::VectorXd* d);

}  // namespace uncertainty_identification
