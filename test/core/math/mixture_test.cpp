#include "uncertainty_identification/math/mixture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

Mixture twoComponents() {
  Matrix2d wide;
  wide << 2, 0.5, 0.5, 1;
  return {{0.25, 0.75}, {Vector2d(3, -1), Vector2d(-1, 2)}, {wide, Matrix2d::Identity()}};
}

TEST(Mixture, MomentsOfTheWhole) {
  const Mixture mixture = twoComponents();
  EXPECT_EQ(mixture.components(), 2);
  EXPECT_EQ(mixture.dimension(), 2);
  EXPECT_LT((mixture.mean() - Vector2d(0, 1.25)).norm(), 1e-15);
  // within: 0.25 wide + 0.75 I; between: 0.25 x 0.75 times the outer product of (4, -3)
  Matrix2d expected;
  expected << 1.25 + 3, 0.125 - 2.25, 0.125 - 2.25, 1 + 1.6875;
  EXPECT_LT((mixture.covariance() - expected).norm(), 1e-14);
}

TEST(Mixture, OfNothing) {
  const Mixture none;
  EXPECT_EQ(none.components(), 0);
  EXPECT_EQ(none.dimension(), 0);
  EXPECT_EQ(none.mean().size(), 0);
  EXPECT_NO_THROW(none.validate("initial"));
}

TEST(Mixture, SortsByTheMeanAndKeepsPartsTogether) {
  Mixture mixture = twoComponents();
  mixture.weights.push_back(0.1);
  mixture.means.push_back(Vector2d(-1, 1));
  mixture.covariances.push_back(3 * Matrix2d::Identity());
  mixture.sortComponents();
  EXPECT_EQ(mixture.weights, (std::vector<double>{0.1, 0.75, 0.25}));
  EXPECT_EQ(mixture.means[0], Vector2d(-1, 1));
  EXPECT_EQ(mixture.means[2], Vector2d(3, -1));
  EXPECT_EQ(mixture.covariances[0](0, 0), 3);
  EXPECT_EQ(mixture.covariances[2](0, 0), 2);
}

TEST(Mixture, AcceptsSingularCovariances) {
  Mixture mixture = twoComponents();
  mixture.covariances[0] << 1, 1, 1, 1;
  mixture.covariances[1].setZero();
  EXPECT_NO_THROW(mixture.validate("initial"));
}

struct Spoiled {
  const char* says;
  std::function<void(Mixture&)> spoil;
};

class InvalidMixture : public testing::TestWithParam<Spoiled> {};

TEST_P(InvalidMixture, NamesTheEntry) {
  Mixture mixture = twoComponents();
  ASSERT_NO_THROW(mixture.validate("initial"));
  GetParam().spoil(mixture);
  const std::string message = messageOf<ConfigurationError>([&] { mixture.validate("initial"); });
  EXPECT_EQ(message.find("initial: "), 0u) << message;
  EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Entries, InvalidMixture,
    testing::Values(
        Spoiled{"equal number, found 2, 2 and 1", [](Mixture& m) { m.covariances.pop_back(); }},
        Spoiled{"weights[1] must be positive",
                [](Mixture& m) {
                  m.weights = {1.0, 0.0};
                }},
        Spoiled{"weights[0] must be positive", [](Mixture& m) { m.weights[0] = std::nan(""); }},
        Spoiled{"must sum to 1, found 1.25", [](Mixture& m) { m.weights[0] = 0.5; }},
        Spoiled{"means[1] must hold 2", [](Mixture& m) { m.means[1] = Eigen::VectorXd::Zero(3); }},
        Spoiled{"means[0] must hold 2 finite", [](Mixture& m) { m.means[0][1] = INFINITY; }},
        Spoiled{"covariances[1] must be a finite 2 x 2",
                [](Mixture& m) { m.covariances[1] = Eigen::MatrixXd::Identity(1, 1); }},
        Spoiled{"covariances[0] must be symmetric", [](Mixture& m) { m.covariances[0](0, 1) = 0; }},
        Spoiled{"covariances[1] must be positive semidefinite",
                [](Mixture& m) { m.covariances[1](0, 0) = -0.1; }}));

}  // namespace
}  // namespace uncertainty_identification
