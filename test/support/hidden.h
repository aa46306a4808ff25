#pragma once

#include <gtest/gtest.h>

#include "simulation/simulate.h"
#include "support/core_setup.h"

/// Truths whose signals are all known, so that single effects can be seen.
namespace uncertainty_identification::test {

/// y(t) = u(t - 1), without noise or model error; white noise goes in.
inline Truth unitDelay(int samples = 200) {
  Truth truth;
  truth.experiments = 3;
  truth.samples = {samples};
  return truth;
}

/// The output one sample later, which is what reaches the plant of unitDelay().
inline Eigen::VectorXd reached(const Experiment& experiment) {
  return experiment.y.tail(experiment.y.size() - 1);
}

inline void expectNear(const Eigen::VectorXd& actual, const Eigen::VectorXd& expected,
                       double tolerance = 1e-12) {
  ASSERT_EQ(actual.size(), expected.size());
  EXPECT_LE((actual - expected).cwiseAbs().maxCoeff(), tolerance);
}

}  // namespace uncertainty_identification::test
