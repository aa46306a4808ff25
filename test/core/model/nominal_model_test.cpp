// What a user's own model inherits from NominalModel: derivatives by differences, coordinates,
// admissibility.
#include "uncertainty_identification/model/nominal_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::vectorOf;

/// gain (1 - p)/(1 - p q^-1) q^-1 with p = exp(-rate).
class FirstOrder : public NominalModel {
 public:
  std::string structure() const override { return "first_order"; }
  std::vector<std::string> names() const override { return {"gain", "rate"}; }
  Polynomials polynomials(const VectorXd& theta) const override {
    const double pole = std::exp(-theta[1]);
    Polynomials p;
    p.b = VectorXd::Constant(1, theta[0] * (1 - pole));
    p.a = VectorXd::Constant(1, -pole);
    return p;
  }
};

TEST(NominalModel, DerivativesByDifferences) {
  const FirstOrder model;
  const VectorXd theta = vectorOf({2.0, 0.4});
  const double pole = std::exp(-0.4);
  Eigen::Matrix2d expected;
  expected << 1 - pole, 2 * pole, 0, pole;
  EXPECT_LT((model.jacobian(theta) - expected).norm(), 1e-9);
  EXPECT_LT((model.unboundedJacobian(theta) - Eigen::Matrix2d::Identity()).norm(), 1e-9);
  EXPECT_EQ(model.toUnbounded(theta), theta);
  EXPECT_EQ(model.units().size(), 2u);
}

TEST(NominalModel, AdmitsStablePolynomialsOnly) {
  const FirstOrder model;
  EXPECT_TRUE(model.admissible(vectorOf({2.0, 0.4})));
  EXPECT_FALSE(model.admissible(vectorOf({2.0, -0.4})));
  EXPECT_FALSE(model.admissible(vectorOf({INFINITY, 0.4})));
}

TEST(NominalModel, AsksForAStartThatItCannotChoose) {
  const FirstOrder model;
  const std::string message =
      messageOf<ConfigurationError>([&] { model.fromPolynomials(Polynomials()); });
  EXPECT_NE(message.find("first_order"), std::string::npos) << message;
  EXPECT_NE(message.find("initial"), std::string::npos) << message;
}

TEST(NominalModel, StacksPolynomialsInTheOrderOfTheta) {
  Polynomials p;
  p.b = vectorOf({1, 2});
  p.a = vectorOf({3});
  p.d = vectorOf({4});
  EXPECT_EQ(p.stacked(), vectorOf({1, 2, 3, 4}));
}

TEST(MakeNominalModel, FollowsTheStructure) {
  NominalModelOptions options;
  options.structure = Structure::armax;
  EXPECT_EQ(makeNominalModel(options, 0.1)->structure(), "armax");
  options.structure = Structure::continuous;
  EXPECT_EQ(makeNominalModel(options, 0.1)->structure(), "continuous");
}

}  // namespace
}  // namespace uncertainty_identification
