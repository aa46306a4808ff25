#pragma once

#include <Eigen/Core>
#include <vector>

#include "math/innovations_form.h"
#include "model/rational_basis.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A rational filter in q^-1 that processes one sample at a time. Its initial state is zero.
class StreamFilter {
 public:
  /// The filter (n0 + n1 q^-1 + ...)/(1 + d1 q^-1 + ...). The denominator is given without its
  /// leading 1.
  StreamFilter(const Eigen::VectorXd& numerator, const Eigen::VectorXd& monic_denominator);

  double step(double in);

 private:
  Eigen::VectorXd numerator_, denominator_, state_;
};

/// The filters that a model consists of. Denominators are monic and lack their leading 1.
struct StreamModel {
  Polynomials polynomials;                  ///< Go and H
  std::vector<Eigen::VectorXd> regressors;  ///< n numerators
  Eigen::VectorXd regressor_denominator;    ///< common to all regressors
  bool regressors_of_input = false;         ///< true: they filter u; false: they filter Go u
  Eigen::VectorXd free_denominator;         ///< of the free response to an initial state
  Eigen::Index free_directions = 0;         ///< number of coefficients of the free response
};

/// A relative error model: the basis filters act on the output of Go.
StreamModel streamModel(const Polynomials& polynomials, const RationalBasis& basis);

/// An error model of BasisKind::sensitivity: the errors are the sensitivities of Go at theta.
StreamModel streamModel(const NominalModel& nominal, const ErrorModelOptions& options,
                        const Eigen::VectorXd& theta);

/// Filters several signals by H^-1, one sample at a time, with the recursion of NoiseWhitening.
class StreamWhitening {
 public:
  StreamWhitening(const Eigen::VectorXd& c, const Eigen::VectorXd& d, NoiseStart start,
                  Eigen::Index signals);

  /// Replaces the next sample of each signal by its whitened value, or by 0 if the output was not
  /// measured.
  void step(bool measured, Eigen::VectorXd* signals);

 private:
  Eigen::VectorXd c_, d_, gain_;
  InnovationsForm noise_;
  bool settled_ = false;   ///< noise_.P = 0: the start is forgotten and gain_ = c_
  Eigen::MatrixXd state_;  ///< order x signals
};

/// Computes residual, regressors and columns of the linear model one sample at a time. The values
/// are those that LinearModel::evaluate() gives for a whole experiment.
class WhitenedStream {
 public:
  /// Uses the options initial_state, discard_samples, noise_start, offsets and offset_side. The
  /// offsets are in the units of u and y.
  WhitenedStream(const StreamModel& model, const EstimationOptions& options, double offset_u,
                 double offset_y);

  /// Processes the next sample; y is NaN if it was not measured. Returns the whitened signals:
  /// residual e, output of the nominal model H^-1 Go u, n regressors Phi, and the diffuse columns.
  /// All are 0 if y was not measured or is discarded.
  const Eigen::VectorXd& step(double u, double y);

  /// Whether the last sample was measured and not discarded.
  bool measured() const { return measured_; }

  Eigen::Index regressors() const { return static_cast<Eigen::Index>(basis_.size()); }

  /// Number of diffuse columns: those of the initial state, and one for an offset of the
  /// experiment.
  Eigen::Index columns() const { return initial_.size() + (own_offset_ ? 1 : 0); }

 private:
  StreamFilter plant_, own_offset_plant_;
  std::vector<StreamFilter> basis_;
  StreamFilter free_response_;
  Eigen::VectorXd
      initial_;  ///< newest samples of the free response: the columns of the initial state
  bool regressors_of_input_, own_offset_, offset_at_input_;
  double offset_u_, offset_y_;
  int discard_ = 0;  ///< samples still to be discarded
  bool first_ = true, measured_ = false;
  Eigen::VectorXd signals_;
  StreamWhitening whitening_;
};

}  // namespace uncertainty_identification
