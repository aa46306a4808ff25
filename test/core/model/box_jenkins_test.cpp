#include "model/box_jenkins.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::vectorOf;
using Names = std::vector<std::string>;

NominalModelOptions options(Structure structure) {
  NominalModelOptions made = test::atRest(2, 2, 1, 3, 2).nominal_model;
  made.structure = structure;
  return made;
}

TEST(BoxJenkins, NamesParametersInTheOrderOfTheta) {
  EXPECT_EQ(makeBoxJenkins(options(Structure::output_error))->names(),
            (Names{"b1", "b2", "a1", "a2"}));
  EXPECT_EQ(makeBoxJenkins(options(Structure::arx))->names(), (Names{"b1", "b2", "a1", "a2"}));
  EXPECT_EQ(makeBoxJenkins(options(Structure::armax))->names(),
            (Names{"b1", "b2", "a1", "a2", "c1"}));
  EXPECT_EQ(makeBoxJenkins(options(Structure::box_jenkins))->names(),
            (Names{"b1", "b2", "a1", "a2", "c1", "d1", "d2", "d3"}));
}

TEST(BoxJenkins, PolynomialsOfEachStructure) {
  const VectorXd theta = vectorOf({1, 2, 0.3, 0.4, 0.5});
  const Polynomials error =
      makeBoxJenkins(options(Structure::output_error))->polynomials(theta.head(4));
  EXPECT_EQ(error.delay, 2);
  EXPECT_EQ(error.b, vectorOf({1, 2}));
  EXPECT_EQ(error.a, vectorOf({0.3, 0.4}));
  EXPECT_EQ(error.c.size() + error.d.size(), 0);
  const Polynomials arx = makeBoxJenkins(options(Structure::arx))->polynomials(theta.head(4));
  EXPECT_EQ(arx.c.size(), 0);
  EXPECT_EQ(arx.d, arx.a);
  const Polynomials armax = makeBoxJenkins(options(Structure::armax))->polynomials(theta);
  EXPECT_EQ(armax.c, vectorOf({0.5}));
  EXPECT_EQ(armax.d, vectorOf({0.3, 0.4}));
}

class Structures : public testing::TestWithParam<Structure> {};

TEST_P(Structures, CoordinatesAndJacobians) {
  const auto model = makeBoxJenkins(options(GetParam()));
  const VectorXd z = 0.7 * VectorXd::Random(model->parameterCount());
  const VectorXd theta = model->fromUnbounded(z);
  EXPECT_TRUE(model->admissible(theta));
  EXPECT_LT((model->toUnbounded(theta) - z).norm(), 1e-12);
  const auto theta_of = [&](const VectorXd& at) { return model->fromUnbounded(at); };
  EXPECT_LT((model->unboundedJacobian(z) - test::differences(theta_of, z)).norm(), 1e-9);
  const auto stacked = [&](const VectorXd& at) { return model->polynomials(at).stacked(); };
  EXPECT_LT((model->jacobian(theta) - test::differences(stacked, theta)).norm(), 1e-9);
  EXPECT_EQ(model->fromPolynomials(model->polynomials(theta)), theta);
  EXPECT_EQ(model->units().size(), model->names().size());
}

INSTANTIATE_TEST_SUITE_P(Family, Structures,
                         testing::Values(Structure::output_error, Structure::arx, Structure::armax,
                                         Structure::box_jenkins));

TEST(BoxJenkins, AdmitsStableMinimumPhaseFiniteModelsOnly) {
  const auto model = makeBoxJenkins(test::atRest(1, 1, 1, 1, 1).nominal_model);
  EXPECT_TRUE(model->admissible(vectorOf({5, 0.9, 0.9, 0.9})));
  EXPECT_FALSE(model->admissible(vectorOf({5, 1.1, 0.9, 0.9})));
  EXPECT_FALSE(model->admissible(vectorOf({5, 0.9, 1.1, 0.9})));
  EXPECT_FALSE(model->admissible(vectorOf({5, 0.9, 0.9, 1.1})));
  EXPECT_FALSE(model->admissible(vectorOf({std::nan(""), 0.9, 0.9, 0.9})));
}

TEST(BoxJenkins, StartsFromPolynomialsOfOtherSizes) {
  const auto model = makeBoxJenkins(test::atRest(2, 1, 1, 1, 1).nominal_model);
  Polynomials p;
  p.b = vectorOf({1});
  p.a = vectorOf({0.5, 0.3});
  EXPECT_EQ(model->fromPolynomials(p), vectorOf({1, 0, 0.5, 0, 0}));
}

TEST(BoxJenkins, RefusesImpossibleOrders) {
  const auto made = [](int nb, int na, int delay) {
    return makeBoxJenkins(test::atRest(nb, na, 0, 0, delay).nominal_model);
  };
  EXPECT_THROW(made(0, 1, 1), ConfigurationError);
  EXPECT_THROW(made(1, -1, 1), ConfigurationError);
  EXPECT_THROW(made(1, 1, -1), ConfigurationError);
}

}  // namespace
}  // namespace uncertainty_identification
