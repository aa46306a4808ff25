#include "curves/refuted_places.h"

#include <gtest/gtest.h>

#include <random>

#include "support/searched_records.h"

namespace uncertainty_identification {
namespace {

/// An electric oven: two lags behind the square of the voltage. Ovens differ in their gain by 10 %.
Experiment oven(unsigned seed) {
  constexpr int kSamples = 400, kHold = 25;
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> level(3, 9);
  Experiment record;
  record.sample_time = 1;
  record.u.resize(kSamples);
  record.y.resize(kSamples);
  const double gain = 1 + 0.1 * normal(engine);
  double u = level(engine), wall = u * u, air = wall;
  for (int k = 0; k < kSamples; ++k) {
    if (k % kHold == 0 && k > 0) u = level(engine);
    record.u[k] = u;
    record.y[k] = 20 + gain * air + 0.3 * normal(engine);
    air += (wall - air) / 1.5;
    wall += (u * u - wall) / 6;
  }
  return record;
}

CurveSearchResult searched() {
  constexpr unsigned kFirst = 101, kCount = 12;
  std::vector<Experiment> all;
  for (unsigned k = 0; k < kCount; ++k) all.push_back(oven(kFirst + k));
  return test::searchedIn(all, 8);
}

// A curve of the sensor, with one of the rate, simulates them better as they are: it imitates the
// gains.
TEST(RefutedPlaces, ACurveThatImitatesDifferencesIsNeitherNamedNorTold) {
  const CurveSearchResult found = searched();
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].place.place, Place::input);
  EXPECT_EQ(found.causes[0].shape, "square");
  for (const TiedCurve& tie : found.causes[0].ties) EXPECT_EQ(tie.place.place, Place::input);
}

}  // namespace
}  // namespace uncertainty_identification
