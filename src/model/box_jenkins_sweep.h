#pragma once

#include <array>
#include <optional>
#include <vector>

#include "model/fused_statistics.h"
#include "model/lane_matrix.h"
#include "model/piecewise_sweep.h"
#include "model/start_columns.h"

namespace uncertainty_identification {

/// The fused sweep of a Box-Jenkins model with FIR error basis (fused_statistics.h).
class BoxJenkinsSweep : public FusedSweep {
 public:
  BoxJenkinsSweep(const FusedInput& input, const Eigen::MatrixXd& T,
                  const EstimationOptions& options, const std::vector<Block>& blocks);

  bool statistics(const Block& block, Statistics* statistics) const override;
  bool sensitivities(const Block& block, const Eigen::MatrixXd& means,
                     std::vector<Eigen::MatrixXd>* products) const override;

 private:
  using Absorption = StartColumns::Absorption;
  using AbsorptionOfLanes = std::array<const Absorption*, kLanes>;

  /// What a first sweep finds about a block's initial values.
  struct InitialValues {
    LaneMatrix values;          ///< of [Phi e], as in SweepStart
    LaneMatrix prior;           ///< the part of [Phi e]'[Phi e] that the prior adds
    LaneMatrix noise_residual;  ///< O'[Phi e], with these values, O the columns of the noise
  };
  struct Sums {
    LaneMatrix gram;         ///< [Phi e]'[Phi e] without the prior's part
    LaneMatrix derivatives;  ///< products of PiecewiseSweep::derivatives() and [Phi e]
    LaneMatrix of_step;      ///< products of step_ and [Phi e]
  };

  Eigen::Index size() const { return model_.regressors() + 1; }  ///< of [Phi e]
  Eigen::Index derived() const { return jacobian_.rows(); }  ///< number of coefficients; 0 if none
  SweepStart rest() const;
  InitialValues initialValues(const Block& block, PiecewiseSweep* sweep) const;
  AbsorptionOfLanes absorptions(const Block& block) const;
  LaneMatrix mapped(const AbsorptionOfLanes& of_lanes, Eigen::MatrixXd Absorption::*matrix,
                    Eigen::Index rows, const LaneMatrix& right) const;
  void addColumnProducts(const Block& block, const PiecewiseSweep& sweep,
                         const std::vector<const double*>& signals, LaneMatrix* products) const;

  void write(const Block& block, const InitialValues& first, const Sums& sums,
             Statistics* statistics) const;
  void writeDerivatives(const Block& block, const InitialValues& first, const Sums& sums,
                        Statistics* statistics) const;
  void writeDerivative(const Block& block, const LaneMatrix& half, int parameter,
                       Statistics* statistics) const;
  LaneMatrix halvesOf(const InitialValues& first, const LaneMatrix& derivatives) const;

  std::vector<Lanes> inputTaps(const LaneMatrix& means) const;
  void moveToMeans(const LaneMatrix& means, LaneMatrix* values) const;
  Eigen::MatrixXd signedJacobian() const;

  SweepModel model_;
  Eigen::MatrixXd T_;
  Eigen::MatrixXd jacobian_;
  StartColumns columns_;
  Eigen::VectorXd residual_signs_, regressor_signs_;  ///< of the derivatives of all coefficients
  std::vector<const double*> column_;                 ///< the columns' first samples
  std::optional<SharedSignal> step_;                  ///< minus the derivative to a common offset
};

}  // namespace uncertainty_identification
