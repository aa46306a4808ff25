#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/math/mixture_coordinates.h"
#include "uncertainty_identification/model/error_basis.h"

namespace uncertainty_identification {

class NominalModel;
class SpreadErrors;
class VaryingPlant;

/// Plants G = q^-delay B/A (1 + sum_k eta_k F_k(q)), one per row.
struct PlantSamples {
  double sample_time = 0;   ///< [s]
  int delay = 0;            ///< [samples]
  Eigen::MatrixXd b;        ///< draws x nb
  Eigen::MatrixXd a;        ///< draws x na, without the leading 1, stable
  Eigen::MatrixXd eta;      ///< draws x taps; without columns there is no error model
  ErrorModelOptions basis;  ///< defines the filters F_k

  int count() const { return static_cast<int>(b.rows()); }
};

/// Which uncertainty the draws contain.
enum class Uncertainty {
  mixture,  ///< only the spread of the plant, with nominal model and mixture as estimated
  total,    ///< also the errors of these estimates (Estimate::joint_covariance)
  estimate  ///< only the errors of the nominal model's estimate: plants with xi = 0
};

/// The distribution of the plant according to an estimate: which G the next experiment may have.
/// theta, xi, eta and Go are explained in docs/notation.md.
class PlantDistribution {
 public:
  /// Throws DataError when the estimate's plant is not stable. `nominal_model` is needed only if
  /// the error model varies parameters of a nominal model that the caller has defined.
  explicit PlantDistribution(const Estimate& estimate,
                             std::shared_ptr<const NominalModel> nominal_model = nullptr);

  /// Go as a single row, without error model.
  const PlantSamples& nominal() const { return nominal_; }

  /// Whether the estimation errors are known. Uncertainty::total needs them.
  bool hasEstimationErrors() const { return root_.size() > 0; }

  /// What the drawn plants do not contain: dynamics that the chosen orders may lack.
  const StructureError& structureError() const { return structure_error_; }

  /// Draws `count` plants as a Latin hypercube: each draw has the exact distribution, and together
  /// they cover it more evenly than independent draws. The same seed gives the same draws. Throws
  /// DataError when the estimation errors are asked for but not known. Where parameters of Go vary,
  /// each draw is a rational function without eta, and draws outside the parameters' domain are
  /// replaced.
  PlantSamples draw(int count, Uncertainty uncertainty, std::uint64_t seed) const;

 private:
  Eigen::VectorXd nominalCoordinates(const Estimate& estimate) const;
  void drawPlant(const Eigen::VectorXd& at, const Eigen::VectorXd& xi, Eigen::Index row,
                 PlantSamples* drawn) const;
  void drawNominal(const Eigen::VectorXd& at, Eigen::Index row, PlantSamples* drawn) const;

  PlantSamples nominal_;
  StructureError structure_error_;
  std::shared_ptr<const VaryingPlant>
      varying_;  ///< null if the error model is filters in series with Go
  ErrorModelOptions basis_;
  Eigen::MatrixXd T_;
  MixtureCoordinates mixture_coordinates_;
  Eigen::VectorXd center_;  ///< estimate of plant and mixture in unbounded coordinates
  Eigen::MatrixXd root_;    ///< square root of its covariance; empty if it is not known
  std::shared_ptr<const SpreadErrors> spread_errors_;  ///< null if it is not known
};

/// Real and imaginary parts, draws x frequencies.
struct ComplexResponses {
  Eigen::MatrixXd real, imaginary;
};

/// Computes frequency responses of the same plants for a few frequencies at a time, without
/// allocating memory.
class ResponseSweep {
 public:
  /// `plants` must outlive this object.
  explicit ResponseSweep(const PlantSamples& plants) : plants_(plants), basis_(plants.basis) {}

  /// G(e^(j omega Ts)) of every draw without its delay, that is times e^(j omega Ts delay); omega
  /// in [rad/s]. The delay is common to all draws and would only turn all phases by the same angle.
  /// The reference stays valid until the next call.
  const ComplexResponses& at(const Eigen::VectorXd& omega);

 private:
  const PlantSamples& plants_;
  ErrorBasis basis_;
  ComplexResponses numerator_, denominator_, error_, response_;
  Eigen::ArrayXXd scale_;
};

/// The responses at all frequencies at once, likewise without the delay.
ComplexResponses frequencyResponses(const PlantSamples& plants, const Eigen::VectorXd& omega);

/// The same with the delay: G(e^(j omega Ts)), draws x frequencies.
Eigen::MatrixXcd delayedResponses(const PlantSamples& plants, const Eigen::VectorXd& omega);

/// G = q^-delay num/den of every draw. The rows hold the coefficients of q^0, q^-1, ...; the first
/// coefficient of den is 1.
struct TransferFunctions {
  Eigen::MatrixXd num, den;
};

/// The plants as transfer functions, with the error model multiplied out.
TransferFunctions transferFunctions(const PlantSamples& plants);

/// Responses of the output to a unit step of the input, starting from rest: draws x steps samples.
Eigen::ArrayXXd stepResponses(const PlantSamples& plants, int steps);

}  // namespace uncertainty_identification
