#pragma once

#include <Eigen/Core>
#include <vector>

#include "curves/free_simulation.h"

namespace uncertainty_identification {

/// Products of residual r and its sensitivities J by theta, X by the initial state, of one window.
/// What the initial state can explain is projected out of r and J in the blocks.
struct WindowProducts {
  struct Block {
    Eigen::MatrixXd jj;
    Eigen::VectorXd jr;
    double rr = 0;
  };
  Eigen::MatrixXd xx, xj;
  Eigen::VectorXd xr;
  double squared_error = 0;  ///< r'r before projection
  std::vector<Block> blocks;
  Eigen::VectorXd residual;  ///< projected

  Block total() const;
};

WindowProducts productsOf(const CurveModel& model, const std::vector<CurveTable>& tables,
                          const SimulationWindow& window, const Eigen::VectorXd& initial,
                          int blocks);

/// Orthonormal columns that span those of `columns`.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns);

/// What the error of a block becomes when theta changes by `step` in the linearised model.
double errorAfter(const WindowProducts::Block& block, const Eigen::VectorXd& step);

}  // namespace uncertainty_identification
