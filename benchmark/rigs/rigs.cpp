#include "rigs/rigs.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification::rigs {
namespace {

using Values = Rig::Values;

double sign(double z) { return std::tanh(z / 1e-3); }
double positive(double z) { return std::max(z, 0.0); }
double limited(double z, double limit) { return std::min(std::max(z, -limit), limit); }
double deadZone(double z, double width) {
  return z > 0 ? positive(z - width) : -positive(-z - width);
}

double firstState(const Values& x, const Values&) { return x[0]; }

/// x0'' = gain u - damping x0' - stiffness x0, for use with an actuator or a sensor.
void secondOrder(const Values& x, double u, const Values& p, Values* rates) {
  *rates = {x[1], p[0] * u - p[1] * x[1] - p[2] * x[0]};
}
void firstOrder(const Values& x, double u, const Values& p, Values* rates) {
  *rates = {(p[0] * u - x[0]) / p[1]};
}

/// A linear plant with an actuator; parameters of the actuator come behind those of the plant.
Rig actuated(const std::string& name,
             std::function<double(double, double, const Values&, double*)> actuator,
             const Values& own, std::vector<std::vector<std::string>> causes,
             double amplitude = 1) {
  Rig rig;
  rig.name = name;
  rig.sample_time = 0.05;
  rig.amplitude = amplitude;
  rig.initial = {0, 0};
  rig.parameters = {4, 1.6, 4};
  rig.parameters.insert(rig.parameters.end(), own.begin(), own.end());
  rig.derivative = secondOrder;
  rig.output = firstState;
  rig.actuator = std::move(actuator);
  rig.causes = std::move(causes);
  return rig;
}

std::vector<Rig> actuators() {
  return {
      actuated("valve with a dead zone and a limit",
               [](double u, double, const Values& p, double*) {
                 return limited(deadZone(u, p[3]), p[4]);
               },
               {0.3, 0.8}, {{"input/dead_zone_saturation", "input/dead_zone", "input/saturation"}}),
      actuated("dead zone",
               [](double u, double, const Values& p, double*) { return deadZone(u, p[3]); }, {0.35},
               {{"input/dead_zone", "input/asymmetric_dead_zone", "play"}}),
      actuated("limit", [](double u, double, const Values& p, double*) { return limited(u, p[3]); },
               {0.6}, {{"input/saturation", "input/tanh"}}),
      actuated("one direction weaker",
               [](double u, double, const Values& p, double*) { return u > 0 ? u : p[3] * u; },
               {0.6}, {{"input/asymmetric_slope", "input/hinge"}}),
      actuated("propeller",
               [](double u, double, const Values&, double*) { return u * std::abs(u); }, {},
               {{"input/signed_square", "input/power", "input/cubic"}}),
      actuated("rate limit",
               [](double u, double, const Values& p, double* held) {
                 return *held += limited(u - *held, p[3]);
               },
               {0.08}, {{"rate_limit"}}),
      actuated("gear with play",
               [](double u, double, const Values& p, double* held) {
                 return *held = std::min(std::max(*held, u - p[3]), u + p[3]);
               },
               {0.3}, {{"play"}}),
      actuated("battery that empties",
               [](double u, double time, const Values& p, double*) {
                 return u * (1 - p[3] * time / 20);
               },
               {0.4}, {{"time_gain"}}),
  };
}

std::vector<Rig> motions() {
  std::vector<Rig> all;
  all.push_back({"motor speed, Coulomb friction",
                 0.02,
                 6,
                 0,
                 {0},
                 {20, 4, 25},
                 [](const Values& x, double u, const Values& p, Values* rates) {
                   *rates = {p[0] * u - p[1] * x[0] - p[2] * sign(x[0])};
                 },
                 firstState,
                 {},
                 {},
                 {{"position/coulomb", "position/asymmetric_coulomb", "position/stribeck",
                   "input/dead_zone", "play"}}});
  all.push_back({"spring and Coulomb friction",
                 0.03,
                 3,
                 0,
                 {0, 0},
                 {6, 1.2, 9, 2.5},
                 [](const Values& x, double u, const Values& p, Values* rates) {
                   *rates = {x[1], p[0] * u - p[1] * x[1] - p[2] * x[0] - p[3] * sign(x[1])};
                 },
                 firstState,
                 {},
                 {},
                 {{"rate/coulomb", "rate/asymmetric_coulomb", "rate/stribeck", "play"}}});
  all.push_back({"drag",
                 0.1,
                 10,
                 0,
                 {0},
                 {1, 0.25, 0.1},
                 [](const Values& x, double u, const Values& p, Values* rates) {
                   *rates = {p[0] * u - p[1] * x[0] - p[2] * x[0] * std::abs(x[0])};
                 },
                 firstState,
                 {},
                 {},
                 {{"position/signed_square", "position/cubic", "position/power"}}});
  all.push_back({"pendulum",
                 0.05,
                 4,
                 0,
                 {0, 0},
                 {1, 0.8, 9.8},
                 [](const Values& x, double u, const Values& p, Values* rates) {
                   *rates = {x[1], p[0] * u - p[1] * x[1] - p[2] * std::sin(x[0])};
                 },
                 firstState,
                 {},
                 {},
                 {{"position/sine", "position/cubic", "position/polynomial"}}});
  all.push_back(
      {"hardening spring",
       0.05,
       4,
       0,
       {0, 0},
       {2, 1, 4, 5},
       [](const Values& x, double u, const Values& p, Values* rates) {
         *rates = {x[1], p[0] * u - p[1] * x[1] - p[2] * x[0] - p[3] * x[0] * x[0] * x[0]};
       },
       firstState,
       {},
       {},
       {{"position/cubic", "position/power", "position/polynomial"}}});
  all.push_back(
      {"end stop on one side",
       0.05,
       2,
       0,
       {0, 0},
       {4, 1.6, 4, 20},
       [](const Values& x, double u, const Values& p, Values* rates) {
         *rates = {x[1], p[0] * u - p[1] * x[1] - p[2] * x[0] - p[3] * positive(x[0] - 0.5)};
       },
       firstState,
       {},
       {},
       {{"position/hinge", "position/exponential", "position/polynomial"}}});
  return all;
}

std::vector<Rig> processes() {
  std::vector<Rig> all;
  all.push_back({"tank",
                 5,
                 0.6,
                 1,
                 {1},
                 {0.02, 0.02},
                 [](const Values& x, double u, const Values& p, Values* rates) {
                   *rates = {p[0] * positive(u) - p[1] * std::sqrt(positive(x[0]))};
                 },
                 firstState,
                 {},
                 {},
                 {{"position/root", "position/power", "position/polynomial", "position/square"}}});
  all.push_back({"heat exchanger",
                 1,
                 0.6,
                 1,
                 {0.5},
                 {0.05, 0.05},
                 [](const Values& x, double u, const Values& p, Values* rates) {
                   *rates = {p[0] * (1 - x[0]) - p[1] * u * x[0]};
                 },
                 firstState,
                 {},
                 {},
                 {{"position_gain", "input_times_position"}}});
  all.push_back({"furnace",
                 10,
                 1,
                 1,
                 {1},
                 {0.02, 0.006, 0.006},
                 [](const Values& x, double u, const Values& p, Values* rates) {
                   *rates = {p[0] * u - p[1] * x[0] - p[2] * std::pow(x[0], 4)};
                 },
                 firstState,
                 {},
                 {},
                 {{"position/cubic", "position/polynomial", "position/sine", "position/square",
                   "position/exponential", "position/power"}}});
  all.push_back({"thermistor",
                 1,
                 1,
                 0,
                 {0},
                 {1, 8},
                 firstOrder,
                 [](const Values& x, const Values&) { return std::exp(-0.9 * x[0]); },
                 {},
                 {},
                 {{"sensor/exponential", "sensor/polynomial", "sensor/square"}}});
  all.push_back({"sensor at its limit",
                 0.05,
                 2,
                 0,
                 {0, 0},
                 {4, 1.6, 4},
                 secondOrder,
                 firstState,
                 {},
                 [](double y, const Values&, double*) { return limited(y, 0.8); },
                 {{"sensor/saturation", "sensor/tanh"}}});
  all.push_back({"slack at the sensor",
                 0.05,
                 2,
                 0,
                 {0, 0},
                 {4, 1.6, 4, 0.25},
                 secondOrder,
                 firstState,
                 {},
                 [](double y, const Values& p, double* held) {
                   return *held = std::min(std::max(*held, y - p[3]), y + p[3]);
                 },
                 {{"output_play"}}});
  return all;
}

std::vector<Rig> pairs() {
  std::vector<Rig> all;
  const auto dead = [](std::size_t at) {
    return [at](double u, double, const Values& p, double*) { return deadZone(u, p[at]); };
  };
  all.push_back(
      {"dead zone and hardening spring",
       0.05,
       4,
       0,
       {0, 0},
       {2, 1, 4, 5, 1.0},
       [](const Values& x, double u, const Values& p, Values* rates) {
         *rates = {x[1], p[0] * u - p[1] * x[1] - p[2] * x[0] - p[3] * x[0] * x[0] * x[0]};
       },
       firstState,
       dead(4),
       {},
       {{"input/dead_zone", "input/asymmetric_dead_zone"},
        {"position/cubic", "position/power", "position/polynomial"}}});
  all.push_back({"limit and drag",
                 0.1,
                 10,
                 0,
                 {0},
                 {1, 0.25, 0.1, 6},
                 [](const Values& x, double u, const Values& p, Values* rates) {
                   *rates = {p[0] * u - p[1] * x[0] - p[2] * x[0] * std::abs(x[0])};
                 },
                 firstState,
                 [](double u, double, const Values& p, double*) { return limited(u, p[3]); },
                 {},
                 {{"input/saturation", "input/tanh"},
                  {"position/signed_square", "position/cubic", "position/power"}}});
  all.push_back({"tank with a dead zone",
                 5,
                 0.6,
                 1,
                 {1},
                 {0.03, 0.02, 0.8},
                 [](const Values& x, double u, const Values& p, Values* rates) {
                   *rates = {p[0] * positive(u) - p[1] * std::sqrt(positive(x[0]))};
                 },
                 firstState,
                 dead(2),
                 {},
                 {{"input/dead_zone", "input/hinge", "input/asymmetric_slope", "input/root"},
                  {"position/root", "position/power", "position/polynomial", "position/square"}}});
  all.push_back({"weak direction and thermistor",
                 1,
                 1,
                 0,
                 {0},
                 {1, 8, 0.5},
                 firstOrder,
                 [](const Values& x, const Values&) { return std::exp(-0.6 * x[0]); },
                 [](double u, double, const Values& p, double*) { return u > 0 ? u : p[2] * u; },
                 {},
                 {{"input/asymmetric_slope", "input/hinge"},
                  {"sensor/exponential", "sensor/polynomial", "sensor/square"}}});
  return all;
}

std::vector<Rig> linearOnes() {
  std::vector<Rig> all;
  all.push_back({"nothing: first order", 1, 1, 0, {0}, {2, 8}, firstOrder, firstState, {}, {}, {}});
  all.push_back({"nothing: second order",
                 0.05,
                 1,
                 0,
                 {0, 0},
                 {4, 1.6, 4},
                 secondOrder,
                 firstState,
                 {},
                 {},
                 {}});
  all.push_back({"nothing: two masses",
                 0.05,
                 1,
                 0,
                 {0, 0, 0, 0},
                 {4, 1, 6, 8},
                 [](const Values& x, double u, const Values& p, Values* rates) {
                   const double spring = p[2] * (x[2] - x[0]) + 0.3 * (x[3] - x[1]);
                   *rates = {x[1], p[0] * u - p[1] * x[1] - x[0] + spring, x[3],
                             -p[3] / 8 * spring - 0.2 * x[3]};
                 },
                 [](const Values& x, const Values&) { return x[2]; },
                 {},
                 {},
                 {}});
  all.push_back({"nothing: sensor with a lag",
                 0.05,
                 1,
                 0,
                 {0, 0, 0},
                 {4, 1.6, 4, 0.15},
                 [](const Values& x, double u, const Values& p, Values* rates) {
                   *rates = {x[1], p[0] * u - p[1] * x[1] - p[2] * x[0], (x[0] - x[2]) / p[3]};
                 },
                 [](const Values& x, const Values&) { return x[2]; },
                 {},
                 {},
                 {}});
  return all;
}

/// Uniform and normal numbers from one stream, the same with any standard library.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15u + 0x1234567u) {}
  double uniform() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<double>(state_ >> 11) / 9007199254740992.0;
  }
  double normal() {
    return std::sqrt(-2 * std::log(uniform() + 1e-300)) * std::cos(2 * M_PI * uniform());
  }

 private:
  std::uint64_t state_;
};

void rungeKutta(const Rig& rig, double u, const Values& p, double step, Values* x) {
  const auto along = [&](const Values& rates, double share) {
    Values moved = *x;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] += share * step * rates[i];
    return moved;
  };
  Values k1, k2, k3, k4;
  rig.derivative(*x, u, p, &k1);
  rig.derivative(along(k1, 0.5), u, p, &k2);
  rig.derivative(along(k2, 0.5), u, p, &k3);
  rig.derivative(along(k3, 1), u, p, &k4);
  for (std::size_t i = 0; i < x->size(); ++i)
    (*x)[i] += step / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
}

Experiment simulated(const Rig& rig, int samples, Draws* draws) {
  constexpr int kSteps = 50;
  Values p = rig.parameters;
  for (double& each : p) each *= 1 + 0.03 * draws->normal();
  Experiment experiment;
  experiment.sample_time = rig.sample_time;
  experiment.u.resize(samples);
  experiment.y.resize(samples);
  Values x = rig.initial;
  double level = 0, actuator_memory = 0, sensor_memory = 0;
  int left = 0;
  for (int k = 0; k < samples; ++k) {
    if (left-- == 0) {
      left = 5 + static_cast<int>(35 * draws->uniform());
      level = rig.offset + rig.amplitude * (2 * draws->uniform() - 1);
    }
    experiment.u[k] = level;
    const double y = rig.output(x, p);
    experiment.y[k] = rig.sensor ? rig.sensor(y, p, &sensor_memory) : y;
    const double u =
        rig.actuator ? rig.actuator(level, k * rig.sample_time, p, &actuator_memory) : level;
    for (int step = 0; step < kSteps; ++step) rungeKutta(rig, u, p, rig.sample_time / kSteps, &x);
  }
  return experiment;
}

}  // namespace

const std::vector<Rig>& allRigs() {
  static const std::vector<Rig> all = [] {
    std::vector<Rig> joined;
    for (const auto& some : {actuators(), motions(), processes(), pairs(), linearOnes()})
      joined.insert(joined.end(), some.begin(), some.end());
    return joined;
  }();
  return all;
}

std::vector<Experiment> record(const Rig& rig, int count, int samples, std::uint64_t seed) {
  Draws draws(seed);
  for (int k = 0; k < 20; ++k) draws.uniform();
  std::vector<Experiment> experiments;
  double squares = 0;
  for (int r = 0; r < count; ++r) {
    experiments.push_back(simulated(rig, samples, &draws));
    experiments.back().id = "run " + std::to_string(r + 1);
    const Eigen::VectorXd& y = experiments.back().y;
    squares += (y.array() - y.mean()).square().mean();
  }
  const double deviation = 0.01 * std::sqrt(squares / count);
  for (Experiment& experiment : experiments)
    for (double& y : experiment.y) y += deviation * draws.normal();
  return experiments;
}

}  // namespace uncertainty_identification::rigs
