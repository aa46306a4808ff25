#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/math/mixture_coordinates.h"
#include "uncertainty_identification/model/error_basis.h"

namespace uncertainty_identification {

class NominalModel;
class VaryingPlant;

/// Plants G = q^-delay B/A (1 + sum_k eta_k F_k(q)), one per row.
struct PlantSamples {
  double sample_time = 0;   ///< [s]
  int delay = 0;            ///< [samples]
  Eigen::MatrixXd b;        ///< draws x nb
  Eigen::MatrixXd a;        ///< draws x na, without the leading 1, stable
  Eigen::MatrixXd eta;      ///< draws x taps; no columns = no error model
  ErrorModelOptions basis;  ///< what the filters F_k are

  int count() const { return static_cast<int>(b.rows()); }
};

/// What the draws differ by.
enum class Uncertainty {
  mixture,  ///< the spread of the plant, with nominal model and mixture as estimated
  total     ///< the errors of these estimates too (Estimate::joint_covariance)
};

/// The distribution of the plant that an estimate stands for: what the next experiment's G may be.
class PlantDistribution {
 public:
  /// Throws DataError when the estimate's plant is not stable. `nominal_model` is needed where the
  /// error model varies the parameters of a nominal model of the caller's own.
  explicit PlantDistribution(const Estimate& estimate,
                             std::shared_ptr<const NominalModel> nominal_model = nullptr);

  /// Go as the only row, without error model.
  const PlantSamples& nominal() const { return nominal_; }

  /// Whether the estimate's errors are known, which Uncertainty::total needs.
  bool hasEstimationErrors() const { return root_.size() > 0; }

  /// A Latin hypercube of `count` draws, each exactly distributed, together more even than
  /// independent ones; the same seed gives the same draws. Throws DataError when the estimate's
  /// errors are asked for but not known. Where parameters of Go vary, each draw is a rational
  /// function without eta, and what lies outside the parameters' domain is drawn again.
  PlantSamples draw(int count, Uncertainty uncertainty, std::uint64_t seed) const;

 private:
  Eigen::VectorXd nominalCoordinates(const Estimate& estimate) const;
  void drawPlant(const Eigen::VectorXd& at, const Eigen::VectorXd& xi, Eigen::Index row,
                 PlantSamples* drawn) const;

  PlantSamples nominal_;
  std::shared_ptr<const VaryingPlant> varying_;  ///< null: filters behind Go
  ErrorModelOptions basis_;
  Eigen::MatrixXd T_;
  MixtureCoordinates mixture_coordinates_;
  Eigen::VectorXd center_;  ///< plant and mixture in unbounded coordinates
  Eigen::MatrixXd root_;    ///< of their covariance; empty = not known
};

/// Real and imaginary parts, draws x frequencies.
struct ComplexResponses {
  Eigen::MatrixXd real, imaginary;
};

/// Frequency responses of the same plants, some frequencies at a time, without allocations.
class ResponseSweep {
 public:
  /// `plants` must outlive this object.
  explicit ResponseSweep(const PlantSamples& plants) : plants_(plants), basis_(plants.basis) {}

  /// G(e^(j omega Ts))/e^(-j omega Ts delay) of every draw, omega [rad/s]: the delay, which all
  /// have in common, turns the phase of all alike. Valid until the next call.
  const ComplexResponses& at(const Eigen::VectorXd& omega);

 private:
  const PlantSamples& plants_;
  ErrorBasis basis_;
  ComplexResponses numerator_, denominator_, error_, response_;
  Eigen::ArrayXXd scale_;
};

/// The same at once.
ComplexResponses frequencyResponses(const PlantSamples& plants, const Eigen::VectorXd& omega);

/// G = q^-delay num/den of every draw, draws x coefficients of the powers of q^-1 from 0 on; the
/// first of den is 1.
struct TransferFunctions {
  Eigen::MatrixXd num, den;
};

/// The error model multiplied out.
TransferFunctions transferFunctions(const PlantSamples& plants);

/// Responses of the output to a unit step of the input, from rest: draws x steps samples.
Eigen::ArrayXXd stepResponses(const PlantSamples& plants, int steps);

}  // namespace uncertainty_identification
