// What a found curve is called in results.
#include "curves/describe_curve.h"

#include <gtest/gtest.h>

#include "curves/shape.h"

namespace uncertainty_identification {
namespace {

const Shape* shapeNamed(const std::string& name) {
  for (const Shape* shape : shapesAt(Place::position))
    if (shape->name == name) return shape;
  return nullptr;
}

/// The name of a power of the position, whose exponent has a standard error of 0.03.
std::string nameOfPower(double exponent) {
  WindowFit fit;
  fit.model.curves = {
      Curve(Place::position, shapeNamed("power"), Eigen::VectorXd::LinSpaced(100, 0.1, 3), 0)};
  fit.model.theta.resize(5);
  fit.model.theta << -0.8, 0.2, 0, -0.1, exponent;
  fit.covariance = 9e-4 * Eigen::MatrixXd::Identity(5, 5);
  FoundCurve found;
  found.place.place = Place::position;
  found.shape = "power";
  return describeCurve(found, fit, SimulationData()).what.name;
}

TEST(DescribeCurve, CallsAPowerByItsExponent) {
  EXPECT_EQ(nameOfPower(0.52), "plant_root");
  EXPECT_EQ(nameOfPower(1.96), "plant_drag");
  EXPECT_EQ(nameOfPower(3.05), "plant_cubic");
  EXPECT_EQ(nameOfPower(0.75), "plant_curve");
}

/// An input from 1 to 3 that meets limits at these values, in standard deviations.
SimulationCause limitsOfInput(double lower, double upper) {
  WindowFit fit;
  for (const Shape* shape : shapesAt(Place::input))
    if (shape->name == "asymmetric_saturation")
      fit.model.curves = {
          Curve(Place::input, shape, Eigen::VectorXd::LinSpaced(100, 1, 3), /*zero=*/0)};
  fit.model.theta.resize(5);
  fit.model.theta << -0.8, 0.2, 0, lower, upper;
  fit.covariance = 1e-4 * Eigen::MatrixXd::Identity(5, 5);
  FoundCurve found;
  found.place.place = Place::input;
  found.shape = "asymmetric_saturation";
  return describeCurve(found, fit, SimulationData());
}

TEST(DescribeCurve, TellsNoLimitThatTheSignalNeverReached) {
  const SimulationCause both = limitsOfInput(1.5, 2.5), upper = limitsOfInput(-2, 2.5);
  EXPECT_EQ(both.values.size(), 2u);
  EXPECT_EQ(both.description, "the input acts through a lower and an upper limit");
  ASSERT_EQ(upper.values.size(), 1u);
  EXPECT_EQ(upper.values[0].name, "upper_limit");
  EXPECT_EQ(upper.description, "the input acts through an upper limit");
  EXPECT_EQ(limitsOfInput(1.5, 4).description, "the input acts through a lower limit");
}

}  // namespace
}  // namespace uncertainty_identification
