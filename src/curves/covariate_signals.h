#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "curves/simulation_data.h"
#include "uncertainty_identification/data/experiment.h"

/// Covariates as the simulation reads them. What acts from afar (a second heater, a load behind a
/// spring) does so through a lag of its own, so each covariate is there behind lags, too.
namespace uncertainty_identification {

/// The covariates that move within some experiment and are known in all of them and of `held`, and
/// each of them behind first-order lags whose time constants are 2, 4, ... 256 times `lag_unit`
/// [s]; with 0 there are no lags. The keys are names for people: "heater behind a lag of 4 s".
std::map<std::string, CovariateScale> covariateScales(const std::vector<Experiment>& experiments,
                                                      const std::vector<Experiment>& held,
                                                      double lag_unit);

/// The signal in an experiment that knows the covariate. Behind a lag, it is that of a covariate
/// that had been constant before.
Eigen::VectorXd signalOf(const CovariateScale& covariate, const Experiment& experiment);

}  // namespace uncertainty_identification
