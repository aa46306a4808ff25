#include "curves/naming.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "curves/fit_comparison.h"
#include "curves/screening_places.h"
#include "curves/starts.h"

namespace uncertainty_identification {
namespace {

/// Windows of a sensor that reads through `curve`, behind a plant of the first order.
template <typename Function>
SimulationData sensorWindows(const Function& curve) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  SimulationData data;
  for (int w = 0; w < 16; ++w) {
    SimulationWindow window;
    window.u.resize(150);
    window.y.resize(150);
    double x = 0, level = 0;
    for (int k = 0; k < 150; ++k) {
      if (k % 10 == 0) level = normal(engine);
      window.u[k] = level;
      window.y[k] = curve(x) + 0.01 * normal(engine);
      x = 0.8 * x + 0.2 * level;
    }
    window.measured = Eigen::ArrayXd::Ones(150);
    window.time = Eigen::VectorXd::LinSpaced(150, 0, 1);
    window.plays = playsOf(window.u);
    data.windows.push_back(window);
    data.groups.push_back(w);
  }
  data.groups.push_back(16);
  data.longest = 150;
  data.samples = 16 * 150;
  data.sample_time = 1;
  return data;
}

/// Windows of a plant of the first order, on which a force acts that depends on its output.
template <typename Function>
SimulationData forcedWindows(const Function& force) {
  std::mt19937_64 engine(2);
  std::normal_distribution<double> normal;
  SimulationData data = sensorWindows([](double x) { return x; });
  for (SimulationWindow& window : data.windows) {
    double x = 0;
    for (int k = 0; k < window.samples(); ++k) {
      window.y[k] = x + 0.01 * normal(engine);
      x = 0.8 * x + 0.2 * (window.u[k] + force(x));
    }
  }
  return data;
}

/// Of a speed, with the force `force` of Coulomb's shape.
SimulationData frictionWindows(double force) {
  return forcedWindows([=](double x) { return force * std::tanh(x / 0.2); });
}

class NamingACurve : public testing::Test {
 protected:
  Naming named(const SimulationData& data, PlaceOf place) {
    const WindowFit before = fitFreely(data, linearStart(data, 1, false, 0), {});
    for (const ScreenedPlace& screened : screenPlaces(data, before, {}, context()))
      if (screened.place.place == place.place)
        return nameCurve(data, before, fitPlace(data, before, screened, context()), screened.fit, 5,
                         context());
    ADD_FAILURE() << "the place was not screened";
    return {};
  }

  CurveSearchContext context() {
    CurveSearchContext made;
    made.pool = &pool_;
    made.going_on = [] { return true; };
    made.excluded = [this](Place, const std::string& shape) {
      return !allowed_.empty() && shape != allowed_ && shape != "curve";
    };
    return made;
  }

  std::string allowed_;  ///< the only shape beside the free curve; empty: all are

 private:
  WorkerPool pool_{1};
};

TEST_F(NamingACurve, NamesTheShapeOfTheTruth) {
  const Naming square =
      named(sensorWindows([](double x) { return x + 0.3 * x * x; }), {Place::sensor, ""});
  EXPECT_TRUE(square.shape == "square" || square.shape == "exponential") << square.shape;
  const Naming limit =
      named(sensorWindows([](double x) { return std::min(std::max(x, -0.6), 0.6); }),
            {Place::sensor, ""});
  EXPECT_EQ(limit.shape, "saturation");
  EXPECT_GT(limit.others.size(), 3u);
}

/// Windows of an input from 0 to 3.3 that acts up to 2.2 only. No start of a limit lies there.
SimulationData limitedWindows() {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 3.3);
  SimulationData data = sensorWindows([](double x) { return x; });
  for (SimulationWindow& window : data.windows) {
    double first = 1, x = 1;
    for (int k = 0; k < window.samples(); ++k) {
      window.u[k] = k % 10 == 0 ? uniform(engine) : window.u[k - 1];
      window.y[k] = x + 0.01 * normal(engine);
      x = 0.8 * x + 0.2 * first;
      first = 0.6 * first + 0.4 * std::min(window.u[k], 2.2);
    }
  }
  return data;
}

TEST_F(NamingACurve, FindsALimitBetweenItsStarts) {
  const Naming found = named(limitedWindows(), {Place::input, ""});
  EXPECT_EQ(found.shape, "saturation");
}

/// What the windows do not tell apart is told as a tie; what they do is not.
TEST_F(NamingACurve, ShapesThatWindowsCannotTellAreAsGood) {
  const Naming found =
      named(sensorWindows([](double x) { return x + 0.1 * x * x; }), {Place::sensor, ""});
  const auto as_good = [&](const char* shape) {
    return std::any_of(found.others.begin(), found.others.end(), [&](const OtherShape& other) {
      return other.shape == shape && other.is_as_good;
    });
  };
  EXPECT_TRUE(found.shape == "exponential" || as_good("exponential")) << found.shape;
  EXPECT_FALSE(as_good("cubic"));
}

/// With little noise no shape is exact, but it is what people call the curve.
TEST_F(NamingACurve, NamesAShapeThatHasNearlyAllOfTheGain) {
  const Naming found =
      named(sensorWindows([](double x) { return x + 0.5 * x * x + 0.03 * std::sin(4 * x); }),
            {Place::sensor, ""});
  EXPECT_NE(found.shape, "curve");
  EXPECT_TRUE(std::any_of(found.others.begin(), found.others.end(), [](const OtherShape& other) {
    return other.shape == "curve" && other.behind < -10;
  })) << "the test is about a curve that BIC prefers by far";
}

/// Where no shape comes close, the curve itself is the answer.
TEST_F(NamingACurve, LeavesACurveOfNoShapeAsItIs) {
  const Naming found = named(sensorWindows([](double x) { return x + 0.25 * std::sin(6 * x); }),
                             {Place::sensor, ""});
  EXPECT_EQ(found.shape, "curve");
  EXPECT_TRUE(found.fit.model.curves.back().isFree());
  for (const OtherShape& other : found.others) EXPECT_GE(other.behind, 2);
}

/// What pushes along with the motion is no friction, though the curve is that of one.
TEST_F(NamingACurve, FrictionOpposesTheMotion) {
  const Naming opposing = named(frictionWindows(-0.3), {Place::position, ""}),
               pushing = named(frictionWindows(0.3), {Place::position, ""});
  const auto is_friction = [](const std::string& shape) {
    return shape.find("coulomb") != std::string::npos || shape == "stribeck";
  };
  EXPECT_TRUE(is_friction(opposing.shape)) << opposing.shape;
  EXPECT_FALSE(is_friction(pushing.shape)) << pushing.shape;
  EXPECT_FALSE(is_friction(pushing.nearest)) << pushing.nearest;
  for (const OtherShape& other : pushing.others) EXPECT_FALSE(is_friction(other.shape));
}

/// A sine that pushes away from zero is no weight that hangs.
TEST_F(NamingACurve, ASineOpposesTheDeflection) {
  allowed_ = "sine";
  const auto shapeOf = [&](double force) {
    return named(forcedWindows([=](double x) { return force * std::sin(2 * x); }),
                 {Place::position, ""})
        .shape;
  };
  EXPECT_EQ(shapeOf(-0.4), "sine");
  EXPECT_EQ(shapeOf(0.4), "curve");
}

/// A tanh that is taken away makes a curve that grows steeper, however well it fits.
TEST_F(NamingACurve, WhatGrowsSteeperDoesNotLevelOff) {
  allowed_ = "tanh";
  const auto shapeOf = [&](double amplitude) {
    return named(sensorWindows([&](double x) { return x + amplitude * std::tanh(2 * x); }),
                 {Place::sensor, ""})
        .shape;
  };
  EXPECT_EQ(shapeOf(1), "tanh");
  EXPECT_EQ(shapeOf(-0.3), "curve");
}

TEST_F(NamingACurve, TheCriterionCountsIndependentSamples) {
  WindowFit fit;
  fit.squared_error = 10;
  fit.residuals = {Eigen::VectorXd::Ones(100)};
  fit.model.theta = Eigen::VectorXd::Zero(4);
  EXPECT_NEAR(criterion(fit, 50), 50 * std::log(0.1) + 4 * std::log(50.0), 1e-12);
}

}  // namespace
}  // namespace uncertainty_identification
