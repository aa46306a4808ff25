#include "curves/curve_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

constexpr int kPlaces = static_cast<int>(Place::input_hysteresis) + 1;

TEST(CurveWords, EveryPlaceAndShapeHasANameAndWords) {
  const std::vector<std::string> names = curveCauseNames();
  for (int index = 0; index < kPlaces; ++index) {
    const PlaceOf at{static_cast<Place>(index), "heat"};
    std::vector<std::string> shapes{"curve"};
    for (const Shape* shape : shapesAt(at.place)) shapes.push_back(shape->name);
    for (const std::string& shape : shapes) {
      const std::string name = causeNamed(at.place, shape);
      EXPECT_TRUE(std::count(names.begin(), names.end(), name)) << nameOf(at.place) << " " << shape;
      EXPECT_GT(inWords(at, shape).size(), 20u);
      EXPECT_FALSE(adviceFor(at.place).empty());
    }
  }
}

TEST(CurveWords, PlacesHaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (int index = 0; index < kPlaces; ++index) names.insert(nameOf(static_cast<Place>(index)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kPlaces));
}

/// Where the physics is the same, the name is that of the catalogue.
TEST(CurveWords, NamesAreThoseOfThePhysics) {
  EXPECT_EQ(causeNamed(Place::input, "dead_zone"), "act_deadzone");
  EXPECT_EQ(causeNamed(Place::input, "saturation"), "act_saturation");
  EXPECT_EQ(causeNamed(Place::input, "asymmetric_slope"), "act_asymmetry");
  EXPECT_EQ(causeNamed(Place::rate, "coulomb"), "plant_coulomb");
  EXPECT_EQ(causeNamed(Place::position, "coulomb"), "plant_coulomb");
  EXPECT_EQ(causeNamed(Place::position, "root"), "plant_root");
  EXPECT_EQ(causeNamed(Place::position, "polynomial"), "plant_cubic");
  EXPECT_EQ(causeNamed(Place::time_gain, "step"), "act_loss");
  EXPECT_EQ(causeNamed(Place::time_gain, "linear"), "plant_drift");
  EXPECT_EQ(causeNamed(Place::play, "play"), "act_backlash");
  EXPECT_EQ(causeNamed(Place::input_hysteresis, "input_hysteresis"), "act_hysteresis");
  EXPECT_EQ(causeNamed(Place::sensor, "square"), "sens_wiener");
}

TEST(CurveWords, TellTheCovariate) {
  EXPECT_TRUE(test::mentions(inWords({Place::covariate_gain, "heat"}, "linear"), "heat"));
}

}  // namespace
}  // namespace uncertainty_identification
