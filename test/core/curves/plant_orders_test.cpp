// Plants of many orders: what a linear plant with more modes explains is no curve, and a curve
// behind several lags is found once they are there.
#include "curves/plant_orders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "curves/explain_simulation.h"

namespace uncertainty_identification {
namespace {

/// Levels of the input between `low` and `high`, each held for `shortest` to `longest` samples.
struct Levels {
  double low, high;
  int shortest, longest;
};

/// Runs of a system that `step` takes from sample to sample, from rest.
template <typename System>
std::vector<Experiment> runsOf(int count, int samples, double sample_time, const Levels& levels,
                               double noise) {
  std::vector<Experiment> all(static_cast<std::size_t>(count));
  for (std::size_t r = 0; r < all.size(); ++r) {
    std::mt19937_64 engine(r + 51);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> level(levels.low, levels.high);
    std::uniform_int_distribution<int> dwell(levels.shortest, levels.longest);
    System system;
    Experiment& run = all[r];
    run.id = "run " + std::to_string(r);
    run.sample_time = sample_time;
    run.u.resize(samples);
    run.y.resize(samples);
    for (int k = 0, next = 0; k < samples; ++k) {
      run.u[k] = k == next ? level(engine) : run.u[k - 1];
      if (k == next) next += dwell(engine);
      run.y[k] = system.output() + noise * normal(engine);
      system.step(run.u[k]);
    }
  }
  return all;
}

SimulationCauses explainedBy(const std::vector<Experiment>& runs) {
  WorkerPool pool(1);
  return explainSimulation({runs.begin(), runs.end() - 1}, {runs.back()}, {}, &pool);
}

/// Three modes of a cantilever, at 9.8, 61 and 172 Hz, 1,000 samples a second.
class Beam {
 public:
  double output() const { return modes_[0].x + modes_[1].x + modes_[2].x; }
  void step(double force) {
    for (Mode& mode : modes_) {
      const double w = 2 * 3.14159265358979 * mode.hertz * 1e-3, c = std::exp(-mode.damping * w);
      const double next = 2 * c * std::cos(w) * mode.x - c * c * mode.before +
                          (1 - 2 * c * std::cos(w) + c * c) * mode.gain * force;
      mode.before = mode.x;
      mode.x = next;
    }
  }

 private:
  struct Mode {
    double hertz, damping, gain, x, before;
  };
  Mode modes_[3] = {{9.8, 0.012, 1, 0, 0}, {61, 0.008, -0.12, 0, 0}, {172, 0.008, 0.02, 0, 0}};
};

TEST(PlantOrders, ABeamOfThreeModesHasNoCurve) {
  const SimulationCauses found = explainedBy(runsOf<Beam>(3, 3000, 1e-3, {-2, 2, 1, 30}, 0.005));
  EXPECT_TRUE(found.causes.empty()) << found.causes.front().description;
  EXPECT_GT(found.fit_after, 96);
}

/// The size of the speed of a pulley on a belt, behind a lag and a resonance at 20 rad/s. Its
/// direction is not seen.
class Pulley {
 public:
  double output() const { return seen_; }
  void step(double voltage) {
    constexpr double kTime = 0.0025, kOwn = 20, kDamping = 0.15, kLag = 3;
    for (int k = 0; k < 8; ++k) {
      drive_ += kTime * kLag * (voltage - drive_);
      rate_ += kTime * (kOwn * kOwn * (drive_ - speed_) - 2 * kDamping * kOwn * rate_);
      speed_ += kTime * rate_;
      seen_ += kTime * 50 * (std::abs(speed_) - seen_);
    }
  }

 private:
  double drive_ = 0, speed_ = 0, rate_ = 0, seen_ = 0;
};

TEST(PlantOrders, ASensorThatDoesNotSeeTheDirectionIsFoundBehindThreeLags) {
  const SimulationCauses found =
      explainedBy(runsOf<Pulley>(4, 700, 0.02, {-0.75, 2.4, 12, 45}, 0.02));
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes.front().what.place, "sensor");
  EXPECT_GT(found.fit_after, 90);
}

/// A servo axis with the friction of Canudas de Wit (1995): bristles that bend before they slip,
/// and hold more than they rub with. Speed [rad/s] by torque [N m], 200 samples a second.
class Axis {
 public:
  double output() const { return speed_; }
  void step(double torque) {
    constexpr double kInertia = 0.0022, kStiffness = 260, kDamping = 0.6, kViscous = 0.018;
    constexpr double kRubs = 0.28, kHolds = 0.34, kStribeck = 0.01, kTime = 5e-5;
    for (int k = 0; k < 100; ++k) {
      const double most = kRubs + (kHolds - kRubs) * std::exp(-std::pow(speed_ / kStribeck, 2));
      const double rate = kStiffness * std::abs(speed_) / most, before = bristle_;
      const double end = rate > 0 ? speed_ / rate : 0;
      bristle_ = rate * kTime > 1e-6 ? end + (bristle_ - end) * std::exp(-rate * kTime)
                                     : bristle_ + kTime * speed_;
      const double force = kStiffness * bristle_ + kDamping * (bristle_ - before) / kTime;
      speed_ += kTime * (torque - force - kViscous * speed_) / kInertia;
    }
  }

 private:
  double speed_ = 0, bristle_ = 0;
};

/// Three curves together simulate its speed better than dry friction alone, which explains nearly
/// all of it.
TEST(PlantOrders, FrictionThatBendsBeforeItSlipsIsOneCause) {
  const SimulationCauses found =
      explainedBy(runsOf<Axis>(3, 2400, 0.005, {-0.62, 0.78, 25, 110}, 0.06));
  ASSERT_EQ(found.causes.size(), 1u) << found.causes.back().description;
  EXPECT_EQ(found.causes.front().what.name, "plant_coulomb");
  EXPECT_EQ(found.causes.front().what.place, "position");
  EXPECT_GT(found.fit_after, found.fit_before + 15);
}

}  // namespace
}  // namespace uncertainty_identification
