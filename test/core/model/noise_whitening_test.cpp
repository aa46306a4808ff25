// Whitening against the textbook Kalman filter, which follows the state of C/D driven by unit white
// noise in another coordinate system and knows nothing of innovations forms.
#include "model/noise_whitening.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::vectorOf;

/// v_t = w_t + sum c_k w_(t-k) - sum d_k v_(t-k) with state x_t = [v_t.., w_t..] and x' = F x + G
/// w.
struct StateSpace {
  MatrixXd F;
  VectorXd G;

  StateSpace(const VectorXd& c, const VectorXd& d) {
    const Eigen::Index nv = std::max<Eigen::Index>(d.size(), 1), size = nv + c.size();
    F = MatrixXd::Zero(size, size);
    G = VectorXd::Zero(size);
    F.row(0).head(d.size()) = -d.transpose();
    F.row(0).tail(c.size()) = c.transpose();
    for (Eigen::Index k = 1; k < nv; ++k) F(k, k - 1) = 1;
    G[0] = 1;
    if (c.size() == 0) return;
    G[nv] = 1;
    for (Eigen::Index k = nv + 1; k < size; ++k) F(k, k - 1) = 1;
  }

  MatrixXd stationaryCovariance() const {
    const Eigen::Index n = F.rows();
    MatrixXd equations = MatrixXd::Identity(n * n, n * n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) equations.block(i * n, j * n, n, n) -= F(i, j) * F;
    }
    const MatrixXd drive = G * G.transpose();
    const VectorXd solved =
        equations.fullPivLu().solve(Eigen::Map<const VectorXd>(drive.data(), n * n));
    return Eigen::Map<const MatrixXd>(solved.data(), n, n);
  }
};

struct Filtered {
  VectorXd innovations;  ///< over their standard deviations, 0 where nothing was measured
  double log_jacobian = 0;
};

Filtered kalmanFilter(const StateSpace& system, bool stationary, int first, const VectorXd& v,
                      const Experiment& experiment) {
  const Eigen::Index n = system.F.rows();
  const MatrixXd drive = system.G * system.G.transpose();
  MatrixXd P = stationary ? system.stationaryCovariance() : drive;  // of x_first
  VectorXd x = VectorXd::Zero(n);
  Filtered out{VectorXd::Zero(v.size()), 0};
  for (int t = first; t < v.size(); ++t) {
    if (experiment.isValid(t)) {
      const double S = P(0, 0);
      const VectorXd gain = P.col(0) / S;
      out.innovations[t] = (v[t] - x[0]) / std::sqrt(S);
      out.log_jacobian -= 0.5 * std::log(S);
      x += gain * (v[t] - x[0]);
      P -= S * gain * gain.transpose();
    }
    x = system.F * x;
    P = system.F * P * system.F.transpose() + drive;
  }
  return out;
}

struct Case {
  VectorXd c, d;
  NoiseStart start;
  double missing;
  int first;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  for (const auto& [c, d] : std::vector<std::pair<VectorXd, VectorXd>>{
           {vectorOf({0.4}), vectorOf({-0.8})},
           {vectorOf({0.5, 0.2}), vectorOf({-1.5, 0.9, -0.2})},
           {vectorOf({0.5, 0.2, -0.1}), vectorOf({-1.2, 0.5})},
           {vectorOf({0.7, 0.3}), VectorXd()},
           {VectorXd(), vectorOf({-0.95})},
           {VectorXd(), VectorXd()}}) {
    for (NoiseStart start : {NoiseStart::zero, NoiseStart::stationary}) {
      for (double missing : {0.0, 0.25}) {
        for (int first : {0, 5}) all.push_back({c, d, start, missing, first});
      }
    }
  }
  return all;
}

std::vector<Experiment> experimentsWithGaps(double missing) {
  test::RandomSystemOptions options;
  options.experiments = 11;
  options.min_samples = 20;
  options.max_samples = 60;
  options.missing = missing;
  return test::randomSystem(options, 9).experiments;
}

TEST(NoiseWhitening, IsAKalmanFilter) {
  for (const Case& one : cases()) {
    const std::vector<Experiment> data = experimentsWithGaps(one.missing);
    const StateSpace system(one.c, one.d);
    for (const Block& block : makeBlocks(data)) {
      const NoiseWhitening whitening(one.c, one.d, one.start, one.first, block, false);
      Signals e;
      whitening.apply(block.y, &e);
      for (int lane = 0; lane < block.lanes; ++lane) {
        const Experiment& experiment = *block.experiments[static_cast<std::size_t>(lane)];
        const Filtered expected = kalmanFilter(system, one.start == NoiseStart::stationary,
                                               one.first, experiment.y, experiment);
        const VectorXd found = e.row(lane).head(experiment.samples()).matrix().transpose();
        EXPECT_LT((found - expected.innovations).norm(), 1e-10 * expected.innovations.norm());
        EXPECT_TRUE(e.row(lane).tail(block.samples - experiment.samples()).isZero(0));
        EXPECT_NEAR(whitening.logJacobian()[lane], expected.log_jacobian, 1e-11);
        int measured = 0;
        for (int t = one.first; t < experiment.samples(); ++t) measured += experiment.isValid(t);
        EXPECT_EQ(whitening.effectiveSamples()[lane], measured);
      }
    }
  }
}

TEST(NoiseWhitening, SensitivitiesMatchDifferences) {
  for (const Case& one : cases()) {
    const std::vector<Experiment> data = experimentsWithGaps(one.missing);
    const Block block = makeBlocks(data).front();
    VectorXd both(one.c.size() + one.d.size());
    both << one.c, one.d;
    const auto whitened = [&](const VectorXd& at) -> VectorXd {
      const NoiseWhitening whitening(at.head(one.c.size()), at.tail(one.d.size()), one.start,
                                     one.first, block, false);
      Signals e;
      whitening.apply(block.y, &e);
      VectorXd all(e.size() + kLanes);
      all << Eigen::Map<const VectorXd>(e.data(), e.size()), whitening.logJacobian().matrix();
      return all;
    };
    const NoiseWhitening whitening(one.c, one.d, one.start, one.first, block, true);
    Signals e;
    std::vector<Signals> derivatives;
    whitening.apply(block.y, &e, &derivatives);
    ASSERT_EQ(static_cast<Eigen::Index>(derivatives.size()), both.size());
    const MatrixXd expected = test::differences(whitened, both);
    for (Eigen::Index j = 0; j < both.size(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      const Eigen::Map<const VectorXd> found(derivatives[at].data(), derivatives[at].size());
      const VectorXd of_e = expected.col(j).head(e.size());
      EXPECT_LT((found - of_e).norm(), 1e-7 * of_e.norm()) << "parameter " << j;
      const Lanes of_jacobian = expected.col(j).tail(kLanes).array();
      EXPECT_LT((whitening.logJacobianDerivatives()[at] - of_jacobian).abs().maxCoeff(), 1e-7);
    }
  }
}

/// From rest and without gaps whitening is the plain filter D/C.
TEST(NoiseWhitening, FromRestIsTheInverseFilter) {
  const VectorXd c = vectorOf({0.5, 0.2}), d = vectorOf({-0.7});
  const std::vector<Experiment> data = experimentsWithGaps(0);
  const Block block = makeBlocks(data).front();
  const NoiseWhitening whitening(c, d, NoiseStart::zero, 0, block, false);
  Signals e;
  whitening.apply(block.y, &e);
  const dense::Matrix inverse =
      dense::toeplitz(dense::impulseResponse(dense::monic(d), dense::monic(c), 0, block.samples));
  const VectorXd y = block.y.row(0).matrix().transpose();
  const VectorXd expected = (inverse * y.cast<dense::Real>()).cast<double>();
  EXPECT_LT((e.row(0).matrix().transpose() - expected).norm(), 1e-11 * expected.norm());
  EXPECT_EQ(whitening.logJacobian()[0], 0);
}

}  // namespace
}  // namespace uncertainty_identification
