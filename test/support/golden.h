#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "support/dense_likelihood.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/math/mixture.h"

/// Golden data in test/data/golden: experiments with likelihood values, gradients and optima that
/// an independent program computed, all with noise and nominal model at rest before the first
/// sample.
namespace uncertainty_identification::test {

/// A parameter point and the values known for it.
struct GoldenPoint {
  Eigen::VectorXd theta;      ///< b, a, c, d concatenated
  Mixture mixture;            ///< of xi
  double noise_variance = 0;  ///< sigma^2
  double log_likelihood = 0;  ///< NaN where not listed
  Eigen::VectorXd
      gradient_theta;  ///< of the log-likelihood, by finite differences; empty where not listed
};

/// One golden data set.
struct Golden {
  std::vector<Experiment> experiments;
  int nb = 0, na = 0, nc = 0, nd = 0;
  int delay = 0;      ///< [samples]
  Eigen::MatrixXd T;  ///< taps x n, FIR basis
  std::vector<GoldenPoint> points;
  GoldenPoint start, optimum;
};

/// Reads test/data/golden/<name>.json and .csv. Throws FileError when one cannot be opened.
Golden readGolden(const std::string& name);

/// The point as a model of the dense reference.
dense::Model denseModel(const Golden& golden, const GoldenPoint& point);

}  // namespace uncertainty_identification::test
