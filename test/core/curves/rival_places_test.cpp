#include "curves/rival_places.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "support/searched_records.h"

namespace uncertainty_identification {
namespace {

/// Advances the state by one sample of the input.
using Plant = std::function<double(double u)>;

/// A record of random steps between 0 and 1, with 0.3 % of noise.
Experiment recordOf(const Plant& advance, int samples, int hold, unsigned seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> level;
  Experiment record;
  record.sample_time = 0.1;
  record.u.resize(samples);
  record.y.resize(samples);
  double x = 0;
  for (int k = 0; k < samples; ++k) {
    record.u[k] = k % hold == 0 ? level(engine) : record.u[k - 1];
    record.y[k] = x + 0.003 * normal(engine);
    x = advance(record.u[k]);
  }
  return record;
}

/// The thrust of a fan: the square of the command, followed faster upwards than downwards.
Plant fan() {
  return [x = 0.0](double u) mutable {
    const double missing = u * u - x;
    return x += (missing > 0 ? 0.35 : 0.02) * missing;
  };
}

/// A valve that stays until the command is 0.2 away, slips to within 0.1, and fills a tank.
Plant stickingValve() {
  return [x = 0.0, stem = 0.0](double u) mutable {
    const double away = u - stem;
    if (std::abs(away) > 0.2) stem = u - std::copysign(0.1, away);
    return x += 0.15 * (stem - x);
  };
}

/// The search in six records, of which two are held out.
CurveSearchResult searched(const std::function<Plant()>& plant, int hold) {
  std::vector<Experiment> all;
  for (unsigned seed = 1; seed <= 6; ++seed) all.push_back(recordOf(plant(), 400, hold, seed));
  return test::searchedIn(all, 4);
}

TEST(RivalPlaces, TheFirstPlaceIsChosenTogetherWithTheCausesBesideIt) {
  const CurveSearchResult found = searched(fan, 50);
  ASSERT_EQ(found.causes.size(), 2u);
  const bool input_first = found.causes[0].place.place == Place::input;
  const FoundCurve &of_input = found.causes[input_first ? 0 : 1],
                   &of_rate = found.causes[input_first ? 1 : 0];
  EXPECT_EQ(of_input.place.place, Place::input);
  EXPECT_EQ(of_input.shape, "square");
  EXPECT_EQ(of_rate.place.place, Place::rate);
  EXPECT_EQ(of_rate.shape, "asymmetric_slope");
}

TEST(RivalPlaces, AreToldAsTiesWhereUnseenWindowsCannotTell) {
  const CurveSearchResult found = searched(stickingValve, 30);
  ASSERT_FALSE(found.causes.empty());
  EXPECT_TRUE(mayBeAt(found.causes[0], Place::play));
}

}  // namespace
}  // namespace uncertainty_identification
