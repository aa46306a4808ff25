// What a found curve is called in results.
#include "curves/describe_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

/// A limit of 2 standard deviations, in the middle of a signal of 4 to both sides, in units of 5.
SimulationCause limitAt(Place place) {
  SimulationData data;
  data.scales.u.unit = data.scales.y.unit = 5;
  WindowFit fit;
  for (const Shape* shape : shapesAt(place))
    if (shape->name == "saturation")
      fit.model.curves = {Curve(place, shape, Eigen::VectorXd::LinSpaced(100, -4, 4), /*zero=*/0)};
  fit.model.theta.resize(4);
  fit.model.theta << -0.8, 0.2, 0, 2;
  fit.covariance = 1e-4 * Eigen::MatrixXd::Identity(4, 4);
  FoundCurve found;
  found.place.place = place;
  found.shape = "saturation";
  return describeCurve(found, fit, data);
}

class DescribeLimit : public testing::TestWithParam<Place> {};

TEST_P(DescribeLimit, DrawsItWhereItIsTold) {
  constexpr double kRounding = 1e-9;
  const SimulationCause cause = limitAt(GetParam());
  ASSERT_EQ(cause.values.size(), 1u);
  const double limit = cause.values[0].value;
  EXPECT_NEAR(cause.curve.value.back(), limit, kRounding);
  EXPECT_NEAR(cause.curve.value.front(), -limit, kRounding);
  for (std::size_t k = 0; k < cause.curve.signal.size(); ++k)
    EXPECT_NEAR(cause.curve.value[k], std::min(std::max(cause.curve.signal[k], -limit), limit),
                kRounding);
}

INSTANTIATE_TEST_SUITE_P(AtPlaces, DescribeLimit,
                         testing::Values(Place::input, Place::loop_error, Place::sensor));

TEST(DescribeCurve, TellsAnActuatorsLimitInUnitsOfItsInput) {
  EXPECT_NEAR(limitAt(Place::input).values[0].value, 10, 1e-9);
  // What enters a sensor is simulated by a plant whose gain belongs to the mean slope, 0.6875 here
  // (integrals over -4 ... 4 of z min(|z|, 2) sign(z) and of z^2), and read back by 1 / 0.6875.
  EXPECT_NEAR(limitAt(Place::sensor).values[0].value, 10 / 0.6875, 0.1);  // 100 points: 1 %
}

// Readings from 0 to 10 of what goes from 0 to 14, clipped at 10. The linear plant simulates the
// straight line through them; its mean and deviation are those of the readings.
TEST(DescribeCurve, TellsALimitOfOneSideAsTheSensorReadsIt) {
  const Eigen::ArrayXd truth = Eigen::ArrayXd::LinSpaced(1001, 0, 14), read = truth.min(10.0);
  SimulationData data;
  data.scales.y.offset = read.mean();
  data.scales.y.unit = std::sqrt((read - read.mean()).square().mean());
  const Eigen::ArrayXd centred = truth - truth.mean();
  const double slope = (centred * read).sum() / centred.square().sum();
  // Scaled so that it has the readings' slope; counted from the readings' mean.
  const Eigen::VectorXd z = slope * centred / data.scales.y.unit;
  const double zero = data.scales.y.zero();
  // Where the truth is 10, z + zero is the limit.
  const double limit = slope * (10 - truth.mean()) / data.scales.y.unit + zero;
  WindowFit fit;
  for (const Shape* shape : shapesAt(Place::sensor))
    if (shape->name == "saturation") fit.model.curves = {Curve(Place::sensor, shape, z, zero)};
  fit.model.theta.resize(4);
  fit.model.theta << -0.8, 0.2, 0, limit;
  fit.covariance = 1e-4 * Eigen::MatrixXd::Identity(4, 4);
  FoundCurve found;
  found.place.place = Place::sensor;
  found.shape = "saturation";
  const SimulationCause cause = describeCurve(found, fit, data);
  ASSERT_EQ(cause.values.size(), 1u);
  // The curve is normalised by a hundred quantiles from 0.2 to 99.8 %.
  EXPECT_NEAR(cause.values[0].value, 10, 0.05);
  EXPECT_NEAR(cause.curve.value.back(), cause.values[0].value, 1e-9);
  EXPECT_NEAR(cause.curve.signal.front(), cause.curve.value.front(), 1e-9) << "slope one below it";
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

/// The linear plant simulates rates from -4 to 4 of its units, 0.1 per sample each; the output was
/// measured to move by at most 0.2 per sample, but for one missing sample.
TEST(DescribeCurve, DrawsFrictionAtRatesThatWereMeasured) {
  SimulationData data;
  SimulationWindow window;
  window.y = 0.2 * Eigen::ArrayXd::LinSpaced(2000, 0, 40).sin().matrix() * 2000 / 40;
  window.measured = Eigen::ArrayXd::Ones(2000);
  window.y[100] = 1e6;
  window.measured[100] = 0;
  data.windows.push_back(window);
  WindowFit fit;
  fit.model.rate_scale = 0.1;
  fit.model.curves = {Curve(Place::rate, shapeNamed("coulomb"),
                            Eigen::VectorXd::LinSpaced(100, -4, 4), /*zero=*/0)};
  fit.model.theta.resize(5);
  fit.model.theta << -0.8, 0.2, 0, -0.1, 0.1;
  fit.covariance = 1e-4 * Eigen::MatrixXd::Identity(5, 5);
  FoundCurve found;
  found.place.place = Place::rate;
  found.shape = "coulomb";
  const CurvePicture drawn = describeCurve(found, fit, data).curve;
  EXPECT_NEAR(drawn.signal.front(), -0.2, 0.001);
  EXPECT_NEAR(drawn.signal.back(), 0.2, 0.001);
}

}  // namespace
}  // namespace uncertainty_identification
