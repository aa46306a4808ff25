#include "model/fixed_plant.h"

#include <gtest/gtest.h>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::vectorOf;

Polynomials plant() {
  Polynomials p;
  p.delay = 3;
  p.b = vectorOf({1, 0.5});
  p.a = vectorOf({-0.7});
  return p;
}

TEST(FixedPlant, HasOnlyTheNoiseForParameters) {
  const auto model = fixPlant(plant(), 1, 2);
  EXPECT_EQ(model->names(), (std::vector<std::string>{"c1", "d1", "d2"}));
  EXPECT_EQ(model->structure(), "box_jenkins");
  const Polynomials p = model->polynomials(vectorOf({0.3, -0.5, 0.2}));
  EXPECT_EQ(p.delay, 3);
  EXPECT_EQ(p.b, plant().b);
  EXPECT_EQ(p.a, plant().a);
  EXPECT_EQ(p.c, vectorOf({0.3}));
  EXPECT_EQ(p.d, vectorOf({-0.5, 0.2}));
  EXPECT_EQ(model->fromPolynomials(p), vectorOf({0.3, -0.5, 0.2}));
  EXPECT_TRUE(model->admissible(vectorOf({0.3, -0.5, 0.2})));
  EXPECT_FALSE(model->admissible(vectorOf({1.3, -0.5, 0.2})));
}

TEST(FixedPlant, CoordinatesAndJacobians) {
  const auto model = fixPlant(plant(), 2, 2);
  const VectorXd z = vectorOf({0.3, -0.6, 1.1, 0.2}), theta = model->fromUnbounded(z);
  EXPECT_LT((model->toUnbounded(theta) - z).norm(), 1e-12);
  const auto theta_of = [&](const VectorXd& at) { return model->fromUnbounded(at); };
  EXPECT_LT((model->unboundedJacobian(z) - test::differences(theta_of, z)).norm(), 1e-9);
  const auto stacked = [&](const VectorXd& at) { return model->polynomials(at).stacked(); };
  EXPECT_LT((model->jacobian(theta) - test::differences(stacked, theta)).norm(), 1e-9);
}

TEST(FixedPlant, WithWhiteNoiseHasNoParameters) {
  const auto model = fixPlant(plant(), 0, 0);
  EXPECT_EQ(model->structure(), "output_error");
  EXPECT_EQ(model->parameterCount(), 0);
  EXPECT_EQ(model->polynomials(VectorXd(0)).b, plant().b);
  EXPECT_EQ(model->jacobian(VectorXd(0)).cols(), 0);
}

}  // namespace
}  // namespace uncertainty_identification
