// The configuration of the model that effects are added to.
#include "explanation/base_model.h"

#include <gtest/gtest.h>

#include <random>

namespace uncertainty_identification {
namespace {

/// First-order plants about levels of their own or about none.
std::vector<Experiment> atLevels(int count, double apart) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all(static_cast<std::size_t>(count));
  for (int r = 0; r < count; ++r) {
    Experiment& experiment = all[static_cast<std::size_t>(r)];
    experiment.sample_time = 1;
    experiment.u.resize(300);
    experiment.y.resize(300);
    double x = 0;
    for (int k = 0; k < 300; ++k) {
      experiment.u[k] = normal(random);
      experiment.y[k] = apart * r + x + 0.1 * normal(random);
      x += 0.3 * (experiment.u[k] - x);
    }
  }
  return all;
}

TEST(OffsetsOfBaseModel, AreOpenWhereOrdersAreAndLevelsDiffer) {
  Configuration asked;
  asked.nominal_model.orders_auto = true;
  EXPECT_EQ(offsetsOfBaseModel(asked, atLevels(4, 2)), Offsets::automatic);
  EXPECT_EQ(offsetsOfBaseModel(asked, atLevels(4, 0)), Offsets::estimate);
  EXPECT_EQ(offsetsOfBaseModel(asked, atLevels(3, 2)), Offsets::estimate) << "none is held out";
  asked.nominal_model.orders_auto = false;
  EXPECT_EQ(offsetsOfBaseModel(asked, atLevels(4, 2)), Offsets::estimate);
  asked.estimation.offsets = Offsets::none;
  EXPECT_EQ(offsetsOfBaseModel(asked, atLevels(4, 2)), Offsets::none) << "as stated";
}

}  // namespace
}  // namespace uncertainty_identification
