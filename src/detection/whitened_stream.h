#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/rational_basis.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A rational filter in q^-1 that takes one sample at a time, from rest.
class StreamFilter {
 public:
  /// (n0 + n1 q^-1 + ...)/(1 + d1 q^-1 + ...); the denominator without its leading 1.
  StreamFilter(const Eigen::VectorXd& numerator, const Eigen::VectorXd& monic_denominator);

  double step(double in);

 private:
  Eigen::VectorXd numerator_, denominator_, state_;
};

/// A model as filters, sample by sample.
struct StreamModel {
  Polynomials polynomials;                  ///< Go and H
  std::vector<Eigen::VectorXd> regressors;  ///< numerators, n of them
  Eigen::VectorXd regressor_denominator;    ///< common, monic, without the leading 1
  bool regressors_of_input = false;         ///< they filter u; else Go u
  Eigen::VectorXd free_denominator;         ///< of what an initial state can do, monic
  Eigen::Index free_directions = 0;         ///< and how many coefficients that has
};

/// Errors as filters behind Go.
StreamModel streamModel(const Polynomials& polynomials, const RationalBasis& basis);

/// BasisKind::sensitivity: errors as sensitivities of Go at theta.
StreamModel streamModel(const NominalModel& nominal, const ErrorModelOptions& options,
                        const Eigen::VectorXd& theta);

/// Noise whitening H^-1 of several signals, sample by sample: the recursion of NoiseWhitening.
class StreamWhitening {
 public:
  StreamWhitening(const Eigen::VectorXd& c, const Eigen::VectorXd& d, NoiseStart start,
                  Eigen::Index signals);

  /// Whitens the signals' next samples in place; where the output is not measured they become 0.
  void step(bool measured, Eigen::VectorXd* signals);

 private:
  Eigen::VectorXd c_, d_, gain_;
  Eigen::MatrixXd covariance_;  ///< covariance of the noise model's state over sigma^2
  bool settled_ = false;        ///< covariance_ = 0: the start is forgotten and gain_ = c
  Eigen::MatrixXd state_;       ///< order x signals
};

/// What the linear model says of a stream of samples, one at a time: the residual, regressors and
/// columns that LinearModel::evaluate() gives for a whole experiment.
class WhitenedStream {
 public:
  /// Of `options` only the nuisance options are used (initial_state, discard_samples, noise_start,
  /// offsets, offset_side); the offsets are values [units of u and y].
  WhitenedStream(const StreamModel& model, const EstimationOptions& options, double offset_u,
                 double offset_y);

  /// Takes the next sample; a y that is NaN was not measured. The signals, whitened: residual e,
  /// effect of the nominal model H^-1 Go u, n regressors Phi, columns(). All 0 where y was not
  /// measured or is discarded.
  const Eigen::VectorXd& step(double u, double y);

  /// Whether the last sample was measured and not discarded.
  bool measured() const { return measured_; }

  Eigen::Index regressors() const { return static_cast<Eigen::Index>(basis_.size()); }

  /// Diffuse columns: of the initial state, and the experiment's own offset.
  Eigen::Index columns() const { return initial_.size() + (own_offset_ ? 1 : 0); }

 private:
  StreamFilter plant_, own_offset_plant_;
  std::vector<StreamFilter> basis_;
  StreamFilter free_response_;
  Eigen::VectorXd initial_;  ///< its newest samples: the effects of the initial state
  bool regressors_of_input_, own_offset_, offset_at_input_;
  double offset_u_, offset_y_;
  int discard_ = 0;  ///< samples still to be discarded
  bool first_ = true, measured_ = false;
  Eigen::VectorXd signals_;
  StreamWhitening whitening_;
};

}  // namespace uncertainty_identification
