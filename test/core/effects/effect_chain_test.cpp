// What each effect makes of a simulation, against its definition written out sample by sample:
// docs/explanation.md, table of effects.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "support/core_setup.h"
#include "support/effect_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// x(t) = 0.6 x(t-1) + 0.9 u(t-1).
VectorXd plant(const VectorXd& u) {
  VectorXd x = VectorXd::Zero(u.size());
  for (Index t = 1; t < u.size(); ++t) x[t] = 0.6 * x[t - 1] + 0.9 * u[t - 1];
  return x;
}

/// The same with f(x(t), x(t-1)) taken from u(t).
VectorXd plantWithLoop(const VectorXd& u, const std::function<double(double, double)>& f) {
  VectorXd x = VectorXd::Zero(u.size());
  for (Index t = 1; t < u.size(); ++t) {
    const double before = t > 1 ? x[t - 2] : 0.0;
    x[t] = 0.6 * x[t - 1] + 0.9 * (u[t - 1] - f(x[t - 1], before));
  }
  return x;
}

VectorXd each(const VectorXd& in, const std::function<double(double)>& f) {
  return in.unaryExpr(f);
}

/// (1 - pole)/(1 - pole q^-1).
VectorXd lag(const VectorXd& in, double pole) {
  VectorXd out = VectorXd::Zero(in.size());
  for (Index t = 0; t < in.size(); ++t)
    out[t] = (t > 0 ? pole * out[t - 1] : 0.0) + (1 - pole) * in[t];
  return out;
}

double sample(const VectorXd& in, Index t) { return t < 0 ? 0.0 : in[t]; }

/// Output that an effect of parameters p leaves of experiment number r, xi = 0.
using Definition =
    std::function<VectorXd(const Experiment& of, const VectorXd& p, const test::EffectSetup&)>;

struct Case {
  std::string name, variant;
  Definition expected;
};

std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name << c.variant; }

Case actuator(const std::string& name,
              const std::function<VectorXd(const VectorXd& u, const VectorXd& p)>& act) {
  return {name, "", [act](const Experiment& of, const VectorXd& p, const test::EffectSetup&) {
            return plant(act(of.u, p));
          }};
}

Case output(const std::string& name, const std::string& variant,
            const std::function<double(double x, double t, double length, const VectorXd& p)>& f) {
  return {name, variant, [f](const Experiment& of, const VectorXd& p, const test::EffectSetup&) {
            VectorXd x = plant(of.u);
            for (Index t = 0; t < x.size(); ++t)
              x[t] = f(x[t], static_cast<double>(t), static_cast<double>(x.size()), p);
            return x;
          }};
}

VectorXd backlash(const VectorXd& u, const VectorXd& p) {
  VectorXd out = u;
  double position = 0;
  for (Index t = 0; t < u.size(); ++t) {
    if (u[t] - position > p[0] / 2) position = u[t] - p[0] / 2;
    if (position - u[t] > p[0] / 2) position = u[t] + p[0] / 2;
    out[t] = position;
  }
  return out;
}

VectorXd rateLimit(const VectorXd& u, const VectorXd& p) {
  VectorXd out = u;
  double position = 0;
  for (Index t = 0; t < u.size(); ++t) {
    position += std::clamp(u[t] - position, -p[0], p[0]);
    out[t] = position;
  }
  return out;
}

std::vector<Case> actuators() {
  return {
      actuator("act_backlash", backlash),
      actuator("act_ratelimit", rateLimit),
      actuator("act_deadzone",
               [](const VectorXd& u, const VectorXd& p) {
                 return each(u, [&](double v) {
                   return std::abs(v) < p[0] ? 0.0 : v - std::copysign(p[0], v);
                 });
               }),
      actuator("act_delay",
               [](const VectorXd& u, const VectorXd& p) {
                 VectorXd out(u.size());  // 1.3 samples
                 for (Index t = 0; t < u.size(); ++t)
                   out[t] = (2 - p[0]) * sample(u, t - 1) + (p[0] - 1) * sample(u, t - 2);
                 return out;
               }),
      actuator("act_hammerstein",
               [](const VectorXd& u, const VectorXd& p) {
                 return each(u, [&](double v) { return v + p[0] * v * v + p[1] * v * v * v; });
               }),
      actuator("act_loss",
               [](const VectorXd& u, const VectorXd& p) {
                 VectorXd out = u;  // from 7.2 s at 0.5 s: sample 14 in part, all from 15 on
                 out[14] *= 1 - 0.6 * p[0];
                 out.tail(u.size() - 15) *= 1 - p[0];
                 return out;
               }),
      actuator("act_offset",
               [](const VectorXd& u, const VectorXd& p) -> VectorXd { return u.array() + p[0]; }),
      actuator("act_quantisation",
               [](const VectorXd& u, const VectorXd& p) {
                 return each(u, [&](double v) { return p[0] * std::round(v / p[0]); });
               }),
      {"act_quantisation", "shifted",
       [](const Experiment& of, const VectorXd& p, const test::EffectSetup&) {
         return plant(
             each(of.u, [&](double v) { return p[1] + p[0] * std::round((v - p[1]) / p[0]); }));
       }},
      actuator("act_saturation",
               [](const VectorXd& u, const VectorXd& p) {
                 return each(u, [&](double v) { return std::clamp(v, -p[0], p[0]); });
               }),
      actuator("plant_drift",
               [](const VectorXd& u, const VectorXd& p) {
                 VectorXd out = u;
                 for (Index t = 0; t < u.size(); ++t)
                   out[t] *=
                       1 + p[0] * (static_cast<double>(t) / static_cast<double>(u.size()) - 0.5);
                 return out;
               }),
  };
}

std::vector<Case> plants() {
  return {
      {"plant_pole", "",
       [](const Experiment& of, const VectorXd& p, const test::EffectSetup&) {
         return lag(plant(of.u), p[0]);
       }},
      {"plant_resonance", "",
       [](const Experiment& of, const VectorXd& p, const test::EffectSetup&) {
         VectorXd beside = VectorXd::Zero(of.u.size());
         for (Index t = 0; t < of.u.size(); ++t)
           beside[t] = 2 * p[0] * std::cos(p[1] * 0.5) * sample(beside, t - 1) -
                       p[0] * p[0] * sample(beside, t - 2) + p[2] * sample(of.u, t - 1) +
                       p[3] * sample(of.u, t - 2);
         return VectorXd(plant(of.u) + beside);
       }},
      {"plant_cubic", "",
       [](const Experiment& of, const VectorXd& p, const test::EffectSetup&) {
         return plantWithLoop(of.u, [&](double x, double) { return p[0] * x * x * x; });
       }},
      {"plant_coulomb", "",
       [](const Experiment& of, const VectorXd& p, const test::EffectSetup&) {
         return plantWithLoop(
             of.u, [&](double x, double before) { return p[0] * std::tanh((x - before) / p[1]); });
       }},
      {"plant_temp", "temp",
       [](const Experiment& of, const VectorXd& p, const test::EffectSetup& setup) {
         double mean = 0;
         for (const Experiment& one : setup.experiments()) mean += one.scalars.at("temp") / 11;
         return plant(of.u * (1 + p[0] * (of.scalars.at("temp") - mean) / 10));
       }},
  };
}

std::vector<Case> sensors() {
  return {
      output("sens_bias", "", [](double x, double, double, const VectorXd& p) { return x + p[0]; }),
      output("sens_drift", "",
             [](double x, double t, double n, const VectorXd& p) { return x + p[0] * t / n; }),
      output(
          "sens_clip", "",
          [](double x, double, double, const VectorXd& p) { return std::clamp(x, -p[0], p[0]); }),
      output("sens_hum", "",
             [](double x, double t, double, const VectorXd& p) {
               return x + p[0] * std::cos(p[2] * 0.5 * t) + p[1] * std::sin(p[2] * 0.5 * t);
             }),
      output("sens_wiener", "",
             [](double x, double, double, const VectorXd& p) {
               return x + p[0] * x * x + p[1] * x * x * x;
             }),
      {"sens_lag", "",
       [](const Experiment& of, const VectorXd& p, const test::EffectSetup&) {
         return lag(plant(of.u), p[0]);
       }},
      {"exp_input2", "flow",
       [](const Experiment& of, const VectorXd& p, const test::EffectSetup&) {
         const VectorXd filtered = lag(of.signals.at("flow"), p[1]);
         VectorXd x = plant(of.u);
         for (Index t = 1; t < x.size(); ++t) x[t] += p[0] * filtered[t - 1];
         return x;
       }},
  };
}

class EffectInTheChain : public testing::TestWithParam<Case> {};

TEST_P(EffectInTheChain, FollowsItsDefinition) {
  const test::EffectSetup setup;
  const auto model = setup.extended({{GetParam().name, GetParam().variant}});
  const VectorXd psi = test::noticeable(*model->effects().front());
  const auto found = setup.simulated(*model, setup.at(psi).parameters);
  for (std::size_t r = 0; r < found.size(); ++r) {
    const VectorXd expected = GetParam().expected(setup.experiments()[r], psi, setup);
    EXPECT_LT((found[r] - expected).cwiseAbs().maxCoeff(), 1e-10) << "experiment " << r;
  }
}

INSTANTIATE_TEST_SUITE_P(Actuator, EffectInTheChain, testing::ValuesIn(actuators()));
INSTANTIATE_TEST_SUITE_P(Plant, EffectInTheChain, testing::ValuesIn(plants()));
INSTANTIATE_TEST_SUITE_P(Sensor, EffectInTheChain, testing::ValuesIn(sensors()));

/// Of a sine that changes slowly, cubic interpolation is good to (0.3)^4/24 of it.
TEST(Interpolated, ReadsBetweenTheSamples) {
  Signals x = Signals::Zero(kLanes, 60), shift = Signals::Constant(kLanes, 60, 0.4);
  shift.row(1).setConstant(-1.7);
  for (int t = 0; t < 60; ++t) x.col(t).setConstant(std::sin(0.3 * t));
  const Signals found = interpolated(x, shift);
  for (int t = 3; t < 57; ++t) {
    EXPECT_NEAR(found(0, t), std::sin(0.3 * (t + 0.4)), 4e-4);
    EXPECT_NEAR(found(1, t), std::sin(0.3 * (t - 1.7)), 4e-4);
  }
  // beyond the end the last sample is held
  EXPECT_NEAR(found(0, 59), x(0, 59), 0.07 * std::abs(x(0, 59) - x(0, 58)));
}

/// The output taken off the grid, by the stamps.
TEST(Jitter, TakesTheOutputAtItsStamps) {
  const test::EffectSetup setup;
  const auto model = setup.extended({{"exp_jitter", ""}});
  const VectorXd at = setup.at(test::vectorOf({1})).parameters;
  const auto found = setup.simulated(*model, at);
  for (std::size_t r = 0; r < found.size(); ++r) {
    const Experiment& of = setup.experiments()[r];
    const VectorXd x = plant(of.u);
    for (Index t = 2; t < x.size() - 2; ++t) {
      const double d = of.stamp_offset[t] / 0.5;
      const Index k = d < 0 ? t - 1 : t;
      const double f = d < 0 ? 1 + d : d;
      double value = 0;  // Lagrange through samples k-1 to k+2
      for (int i = -1; i <= 2; ++i) {
        double weight = 1;
        for (int j = -1; j <= 2; ++j)
          if (j != i) weight *= (f - j) / (i - j);
        value += weight * x[k + i];
      }
      EXPECT_NEAR(found[r][t], value, 1e-10);
    }
  }
}

/// The means of the error parameters move with the place in the series.
TEST(Aging, MovesTheErrorParameters) {
  const test::EffectSetup setup;
  const auto model = setup.extended({{"plant_aging", ""}});
  const VectorXd shift = test::vectorOf({0.2, -0.3});
  const auto found = setup.simulated(*model, setup.at(shift).parameters);
  Eigen::MatrixXd xi(2, 11);
  for (int r = 0; r < 11; ++r) xi.col(r) = shift * (r / 10.0 - 0.5);
  const auto expected = setup.simulated(*setup.extended({}), setup.at().parameters, xi);
  for (std::size_t r = 0; r < found.size(); ++r)
    EXPECT_LT((found[r] - expected[r]).cwiseAbs().maxCoeff(), 1e-10);
}

/// Experiments that were not fitted to stand where they began among those that were.
TEST(Aging, GoesByTheExperimentsBeginnings) {
  std::vector<Experiment> recorded = test::recordedForEffects();
  for (std::size_t r = 0; r < recorded.size(); ++r)
    recorded[r].start_time = 100.0 * static_cast<double>(r);
  const test::EffectSetup setup(test::effectConfiguration(), recorded);
  const auto model = setup.extended({{"plant_aging", ""}});
  const VectorXd shift = test::vectorOf({0.2, -0.3});
  std::vector<Experiment> others(4, recorded[0]);
  const double begins[] = {-50, 0, 725, 5000}, places[] = {0, 0, 7.25, 10};
  for (std::size_t r = 0; r < others.size(); ++r) others[r].start_time = begins[r];
  const Block block = makeBlocks(others).front();
  Eigen::MatrixXd xi(2, 4), none = Eigen::MatrixXd::Zero(2, 4);
  for (int r = 0; r < 4; ++r) xi.col(r) = shift * (places[r] / 10 - 0.5);
  const auto found = model->forExperiments(4)->simulated(block, setup.at(shift).parameters, none);
  const auto expected =
      setup.extended({})->forExperiments(4)->simulated(block, setup.at().parameters, xi);
  EXPECT_LT((found.expected() - expected.expected()).topRows(4).abs().maxCoeff(), 1e-10);
}

}  // namespace
}  // namespace uncertainty_identification
