#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "identification/structure_fit.h"

/// The plants of single experiments, as sums of modes.
namespace uncertainty_identification {

/// A structure, and a plant of it.
struct ModalStart {
  NominalModelOptions structure;
  StartingPoint plant;
};

/// The modal structure of the order with which single experiments together have the least BIC, and
/// that most of their plants have, with the one of these that simulates all experiments best. None
/// where there is none.
std::optional<ModalStart> modalStart(const Problem& problem, Journal* journal);

/// The plants of single experiments in the unbounded coordinates of one modal structure, a column
/// each, with the covariance of their errors of estimation: the inverse of their mean information.
struct OwnPlants {
  Eigen::MatrixXd coordinates;
  std::vector<Eigen::Index> experiments;  ///< their numbers among all
  Eigen::MatrixXd covariance;
  Eigen::VectorXd noise;  ///< its parameters c and d, and its variance: medians
};

/// The plants of at most 40 experiments in the structure of the problem's nominal model, with their
/// phases within half a turn of their circular mean. None of fewer than three.
std::optional<OwnPlants> ownPlants(const Problem& problem, const StartingPoint& start,
                                   Journal* journal);

/// Median of each row.
Eigen::VectorXd medians(const Eigen::MatrixXd& values);

}  // namespace uncertainty_identification
