#include "curves/shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace uncertainty_identification {
namespace {

double valueOf(const std::string& name, double z, std::vector<double> parameters = {}) {
  for (const Shape& shape : shapes())
    if (shape.name == name) return shape.value(z, parameters.data());
  ADD_FAILURE() << "no shape " << name;
  return 0;
}

TEST(Shapes, StartsFitTheirParameters) {
  std::set<std::string> names;
  for (const Shape& shape : shapes()) {
    EXPECT_TRUE(names.insert(shape.name).second) << shape.name;
    ASSERT_FALSE(shape.starts.empty()) << shape.name;
    for (const std::vector<double>& start : shape.starts) {
      EXPECT_EQ(start.size(), shape.parameters.size()) << shape.name;
      for (const double z : {-3.0, -0.4, 0.0, 0.7, 2.5})
        EXPECT_TRUE(std::isfinite(shape.value(z, start.data()))) << shape.name << " at " << z;
    }
    EXPECT_EQ(shape.count(), static_cast<int>(shape.parameters.size()) + (shape.is_whole ? 0 : 1));
  }
}

TEST(Shapes, AreTheCurvesOfTheirNames) {
  EXPECT_DOUBLE_EQ(valueOf("dead_zone", 0.4, {0.5}), 0);
  EXPECT_DOUBLE_EQ(valueOf("dead_zone", -2, {0.5}), -1.5);
  EXPECT_DOUBLE_EQ(valueOf("saturation", 3, {0.95}), 0.95);
  EXPECT_DOUBLE_EQ(valueOf("saturation", -0.5, {0.95}), -0.5);
  EXPECT_DOUBLE_EQ(valueOf("asymmetric_dead_zone", -1, {0.1, 0.5}), -0.5);
  EXPECT_DOUBLE_EQ(valueOf("asymmetric_saturation", -0.5, {0.2, 1.5}), 0.2);
  EXPECT_DOUBLE_EQ(valueOf("asymmetric_saturation", 2, {0.2, 1.5}), 1.5);
  EXPECT_DOUBLE_EQ(valueOf("signed_square", -3), -9);
  EXPECT_DOUBLE_EQ(valueOf("root", 2, {-2}), 2);
  EXPECT_DOUBLE_EQ(valueOf("root", -3, {-2}), 0);
  EXPECT_NEAR(valueOf("coulomb", -1, {0.05}), -1, 1e-12);
  EXPECT_NEAR(valueOf("asymmetric_coulomb", 1, {0.05, 0.3}), 1.3, 1e-12);
  EXPECT_NEAR(valueOf("stribeck", 0.3, {0.01, 1, 0.28}), 1 + std::exp(-1.0), 1e-9);
  EXPECT_DOUBLE_EQ(valueOf("hinge", 2, {1.5}), 0.5);
  EXPECT_DOUBLE_EQ(valueOf("asymmetric_slope", -2), 0);
}

TEST(Shapes, EachPlaceWithACurveHasSome) {
  for (int index = 0; index <= static_cast<int>(Place::input_hysteresis); ++index) {
    const auto place = static_cast<Place>(index);
    EXPECT_EQ(shapesAt(place).empty(), isScalar(place)) << nameOf(place);
  }
}

}  // namespace
}  // namespace uncertainty_identification
