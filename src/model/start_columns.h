#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "model/shared_signal.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// The coefficients [b; a; c; d]: where those of A, C and D begin, and how many there are.
struct CoefficientLayout {
  explicit CoefficientLayout(const Polynomials& p);
  Eigen::Index a, c, d, size;
};

/// The covariance of the noise model's state at the first sample, relative to sigma^2, and its
/// derivatives with respect to c1.., d1... Empty where the noise starts from rest.
struct NoiseStartCovariance {
  NoiseStartCovariance() = default;
  NoiseStartCovariance(const Polynomials& p, bool derivatives);
  Eigen::MatrixXd value, root;   ///< value = root root'
  Eigen::MatrixXd inverse_root;  ///< empty if the covariance is singular
  std::vector<Eigen::MatrixXd> derivatives;
};

/// The columns Z of unknown initial values, which in records without gaps are the same for all
/// experiments: residual = omega + Z s with, in this order,
///   the state of the noise model at the first sample,   q^-i/C,        covariance as above;
///   the state of Go,                                    q^-k D/(A C),  precision p;
///   an experiment's own offset,                         D/C 1,         precision p.
/// (docs/method.md, section on random-effect columns.)
class StartColumns {
 public:
  /// `states`: number of directions of Go's state. `lengths`: those of all experiments.
  StartColumns(const Polynomials& p, int states, const EstimationOptions& options,
               std::vector<int> lengths, bool derivatives);

  /// What integrating over s needs, for records of one length. It is a linear map of Z'signal.
  struct Absorption {
    Eigen::MatrixXd estimate;        ///< s = estimate Z'signal, the most likely initial values
    Eigen::MatrixXd prior;           ///< their misfit to the prior: (Z'signal)' prior (Z'signal)
    Eigen::MatrixXd noise_residual;  ///< O'(signal - Z s) for the columns O of the noise's state
    Eigen::MatrixXd noise_gram;      ///< O'O with all columns integrated out
    double log_jacobian = 0;
    Eigen::VectorXd log_jacobian_derivatives;  ///< with respect to [b; a; c; d]
    double lost_samples = 0;  ///< that a flat prior or one of fixed variance takes up
  };

  int count() const { return noise_ + states_ + (step_ ? 1 : 0); }
  int noise() const { return noise_; }
  int states() const { return states_; }
  bool ownOffset() const { return step_.has_value(); }

  /// Number of samples after which all columns have vanished, except that of an own offset.
  int duration() const { return duration_; }

  /// Column k from sample 0 on; it may be read a piece beyond its end.
  const double* column(int k) const;

  const Absorption& absorption(int length) const;

  /// Derivatives of the initial noise's covariance with respect to c1.., d1...
  const std::vector<Eigen::MatrixXd>& covarianceDerivatives() const { return start_.derivatives; }

 private:
  /// Columns that are delayed copies of one signal, and the derivatives of this signal: with
  /// respect to coefficient first + j it is sign times `signal` delayed by j + 1.
  struct Derivative {
    Eigen::Index first;
    int count;
    double sign;
    SharedSignal signal;
  };
  struct Family {
    int first, count;
    const SharedSignal* signal;
    std::vector<Derivative> derivatives;
  };
  std::vector<Family> families(const Polynomials& p, const CoefficientLayout& layout, int lag,
                               bool derivatives) const;
  Absorption absorb(const Eigen::MatrixXd& gram) const;
  void prepare(const Polynomials& p, int lag, std::vector<int> lengths, bool derivatives);

  int noise_ = 0, states_ = 0, duration_ = 0;
  int longest_ = 0;  ///< record for which there is an absorption of its own
  double precision_, samples_of_prior_, log_prior_;
  NoiseStartCovariance start_;
  std::optional<SharedSignal> of_noise_, of_state_, step_;
  std::vector<std::pair<int, Absorption>> absorptions_;  ///< by length, ascending
};

}  // namespace uncertainty_identification
