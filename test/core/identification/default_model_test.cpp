// What the default configuration makes of families of plants: the structure chosen, the bands, and
// whether they are to be trusted. The plants are simulated here, exactly, and not by the package.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "identification/steps.h"
#include "support/mentions.h"
#include "uncertainty_identification/bounds/bounds.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

constexpr double kPeriod = 0.05;  // [s]
constexpr double kGain = 3, kTau = 0.4, kNoise = 0.03;

/// A family of first-order plants behind a zero-order hold, whose input may saturate.
struct Family {
  double gain_spread = 0, tau_spread = 0;
  double dead_zone = 0;  ///< [unit of u]
};

struct Plant {
  double gain, tau;

  double magnitude(double omega) const {
    const double pole = std::exp(-kPeriod / tau);
    return std::abs(gain * (1 - pole) / (std::polar(1.0, omega * kPeriod) - pole));
  }
};

class Families : public testing::Test {
 protected:
  Plant draw(const Family& family) {
    return {kGain * (1 + family.gain_spread * normal()), kTau * (1 + family.tau_spread * normal())};
  }

  std::vector<Experiment> measured(const Family& family, int count, int samples) {
    std::vector<Experiment> all;
    for (int r = 0; r < count; ++r) {
      const Plant plant = draw(family);
      Experiment one;
      one.id = "run_" + std::to_string(r);
      one.sample_time = kPeriod;
      one.u.resize(samples);
      one.y.resize(samples);
      const double pole = std::exp(-kPeriod / plant.tau);
      double x = 0, level = 1;
      for (int t = 0; t < samples; ++t) {
        if (t % 8 == 0) level = normal();
        one.u[t] = level;
        one.y[t] = x + kNoise * normal();
        const double excess = std::max(0.0, std::abs(level) - family.dead_zone);
        x = pole * x + plant.gain * (1 - pole) * std::copysign(excess, level);
      }
      all.push_back(std::move(one));
    }
    return all;
  }

  /// Share of new plants whose magnitude lies inside the band of 95 %, mean over the frequencies.
  double held(const Family& family, const Bounds& bounds) {
    constexpr int kPlants = 400;
    const UncertaintyBands& bands = bounds.frequency.magnitude_bands;
    const Band& band = (bands.total.empty() ? bands.mixture : bands.total).pointwise[2];
    const Eigen::VectorXd& omega = bounds.frequency.omega;
    double inside = 0;
    for (int k = 0; k < kPlants; ++k) {
      const Plant plant = draw(family);
      for (Eigen::Index i = 0; i < omega.size(); ++i) {
        const double magnitude = plant.magnitude(omega[i]);
        inside += magnitude >= band.lower[i] && magnitude <= band.upper[i] ? 1 : 0;
      }
    }
    return inside / (kPlants * static_cast<double>(omega.size()));
  }

 private:
  double normal() { return std::normal_distribution<double>()(random_); }

  std::mt19937_64 random_{7};
};

Estimate identified(const std::vector<Experiment>& experiments) {
  Configuration configuration;
  configuration.bounds.frequencies = 50;
  return Identifier(configuration).identify(experiments);
}

std::string chosen(const Estimate& estimate) {
  for (const Candidate& candidate : estimate.candidates)
    if (candidate.choice == "error model" && candidate.chosen) return candidate.description;
  return "";
}

// Bands of 30 experiments: the estimated variance alone has a relative standard deviation of 26 %,
// which is 88 to 98 % coverage for a single data set.
TEST_F(Families, GainAndTimeConstantThatVaryAreFoundAndTheBandHolds) {
  const Family family{0.1, 0.1, 0};
  const Estimate estimate = identified(measured(family, 30, 150));
  EXPECT_EQ(chosen(estimate), "parameter_spread of gain and tau1");
  EXPECT_EQ(estimate.nominal_model.structure, "continuous");
  EXPECT_TRUE(estimate.trust.trusted) << estimate.trust.reasons.front();
  EXPECT_TRUE(test::mentions(estimate.variation, "gain differs by")) << estimate.variation;
  EXPECT_TRUE(test::mentions(estimate.variation, "time constant tau1")) << estimate.variation;
  const double share = held(family, computeBounds(estimate));
  EXPECT_GT(share, 0.86);
  EXPECT_LT(share, 0.995);
}

TEST_F(Families, AGainThatVariesTakesOneParameterAndTheBandHolds) {
  const Family family{0.08, 0, 0};
  const Estimate estimate = identified(measured(family, 30, 150));
  EXPECT_EQ(estimate.error_model.mixture.dimension(), 1) << chosen(estimate);
  EXPECT_TRUE(plantsDiffer(estimate)) << estimate.variation;
  EXPECT_TRUE(estimate.trust.trusted) << estimate.trust.reasons.front();
  const double share = held(family, computeBounds(estimate));
  EXPECT_GT(share, 0.86);
  EXPECT_LT(share, 0.995);
}

TEST_F(Families, NoErrorModelWherePlantsDoNotDiffer) {
  const Estimate estimate = identified(measured({}, 20, 150));
  EXPECT_EQ(chosen(estimate), "none");
  EXPECT_EQ(estimate.error_model.mixture.dimension(), 0);
  EXPECT_TRUE(test::mentions(estimate.variation, "no difference")) << estimate.variation;
  EXPECT_FALSE(plantsDiffer(estimate));
}

// Equal plants leave the covariance at its lower limit, which is no difference to speak of.
TEST_F(Families, EqualPlantsAreNotSaidToDifferWhereTheErrorModelIsStated) {
  Configuration stated;
  stated.error_model = paperErrorModel();
  stated.error_model.taps = 1;
  stated.error_model.constraint = Constraint::zero_mean;
  const Estimate estimate = Identifier(stated).identify(measured({}, 4, 150));
  EXPECT_GT(estimate.error_model.mixture.dimension(), 0);
  EXPECT_EQ(estimate.variation.rfind("The experiments show no difference", 0), 0u)
      << estimate.variation;
}

TEST_F(Families, ThreeExperimentsAreNotTrusted) {
  const Estimate estimate = identified(measured({0.1, 0.1, 0}, 3, 150));
  EXPECT_FALSE(estimate.trust.trusted);
  EXPECT_TRUE(test::mentions(estimate.trust.reasons.front(), "too few"));
  EXPECT_FALSE(computeBounds(estimate).trust.trusted);
}

TEST_F(Families, APlantThatIsNotLinearIsNotTrusted) {
  const Estimate estimate = identified(measured({0.05, 0, 0.5}, 30, 150));
  EXPECT_FALSE(estimate.trust.trusted);
}

// A fixed plant in white noise has no parameters but the offset.
TEST_F(Families, APlantFittedToItsSimulationNeedsNoNoiseModel) {
  Configuration configuration;
  configuration.nominal_model.fit = PlantFit::simulation;
  const Estimate estimate = Identifier(configuration).identify(measured({}, 1, 400));
  EXPECT_TRUE(estimate.usable()) << estimate.message;
  EXPECT_EQ(estimate.nominal_model.c.size(), 0);
}

TEST_F(Families, TheStatedErrorModelIsKept) {
  Configuration configuration;
  configuration.error_model = paperErrorModel();
  const Estimate estimate = Identifier(configuration).identify(measured({0.1, 0.1, 0}, 12, 150));
  EXPECT_EQ(estimate.error_model.options.basis, BasisKind::fir);
  EXPECT_EQ(estimate.error_model.options.constraint, Constraint::zero_static_gain);
  EXPECT_EQ(chosen(estimate), "");
}

}  // namespace
}  // namespace uncertainty_identification
