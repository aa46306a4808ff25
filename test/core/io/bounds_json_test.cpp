#include "io/bounds_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/core_setup.h"
#include "support/plain_estimate.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

Bounds someBounds() {
  Estimate estimate = test::plainEstimate(test::vectorOf({1.0, 0.3}), test::vectorOf({-0.5}), 1e-5);
  estimate.configuration.bounds.frequencies = 50;
  estimate.configuration.bounds.weight_order = 1;
  return computeBounds(estimate);
}

TEST(BoundsJson, RoundTrip) {
  const Bounds bounds = someBounds();
  const nlohmann::json tree = toJson(bounds);
  EXPECT_EQ(toJson(boundsFromJson(tree)), tree);
  const Bounds again = boundsFromJson(tree);
  EXPECT_EQ(again.weight->num, bounds.weight->num);  // every bit
  EXPECT_EQ(again.regions.size(), bounds.regions.size());
  const Eigen::VectorXd& upper = bounds.frequency.magnitude_bands.total.pointwise[1].upper;
  const Eigen::VectorXd& read = again.frequency.magnitude_bands.total.pointwise[1].upper;
  EXPECT_LT((upper - read).cwiseAbs().maxCoeff(), 1e-5 * upper.maxCoeff());
}

TEST(BoundsJson, NamesWhatIsMissing) {
  nlohmann::json tree = toJson(someBounds());
  tree["frequency"].erase("omega");
  try {
    boundsFromJson(tree);
    FAIL();
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("frequency.omega"), std::string::npos) << error.what();
  }
}

TEST(BoundsJson, RefusesBandsThatDoNotFitTheirGrid) {
  const nlohmann::json tree = toJson(someBounds());
  for (const char* pointer : {"/frequency/omega", "/levels", "/step/time", "/weight/omega",
                              "/frequency/magnitude_bands/total/pointwise/1/upper"}) {
    nlohmann::json shorter = tree;
    nlohmann::json& list = shorter[nlohmann::json::json_pointer(pointer)];
    list.erase(list.size() - 1);
    EXPECT_THROW(boundsFromJson(shorter), ConfigurationError) << pointer;
  }
}

/// No weight is no key, and read so.
TEST(BoundsJson, WithoutAWeight) {
  Bounds bounds = someBounds();
  bounds.weight.reset();
  const nlohmann::json tree = toJson(bounds);
  EXPECT_FALSE(tree.contains("weight"));
  EXPECT_FALSE(boundsFromJson(tree).weight.has_value());
}

}  // namespace
}  // namespace uncertainty_identification
