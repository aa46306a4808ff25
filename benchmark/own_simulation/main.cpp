// How often explain names what is wrong with a user's simulation (docs/own_simulation.md,
// Measured). usage: benchmark_own_simulation [SEEDS]
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "own_simulation/examine.h"
#include "own_simulation/linear_simulation.h"
#include "own_simulation/logged_simulation.h"
#include "support/own_machine.h"

namespace uncertainty_identification {
namespace {

constexpr double kShare = 0.05;  ///< of the output's variance that a flaw changes
constexpr int kHeld = 6;

using Curve = std::function<Eigen::VectorXd(const Eigen::VectorXd& signal, double size)>;

/// A flaw of a size that is chosen so that it changes kShare of the variance.
struct Flaw {
  std::string name;
  std::vector<std::string> accepted;  ///< names, or "parameter:<name>"
  int parameter = -1;                 ///< multiplied by 1 + size
  Curve input, output;
};

Eigen::VectorXd valuesOf(const Simulation& simulation) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(simulation.parameters().size()));
  for (Eigen::Index k = 0; k < values.size(); ++k)
    values[k] = simulation.parameters()[static_cast<std::size_t>(k)].value;
  return values;
}

MachineOptions optionsFor(const Flaw& flaw, double size, std::uint64_t seed) {
  MachineOptions options;
  options.seed = seed;
  if (flaw.input)
    options.input_curve = [&flaw, size](const Eigen::VectorXd& u) { return flaw.input(u, size); };
  if (flaw.output)
    options.output_change = [&flaw, size](const Eigen::VectorXd& y, int) {
      return flaw.output(y, size);
    };
  return options;
}

std::vector<Experiment> recorded(Simulation& simulation, const Flaw& flaw, double size,
                                 std::uint64_t seed, bool noise) {
  MachineOptions options = optionsFor(flaw, size, seed);
  if (!noise) options.noise = 0;
  return recordWithFactor(simulation, flaw.parameter, 1 + size, options);
}

/// Share of the variance that the flaw changes.
double shareOf(Simulation& simulation, const Flaw& flaw, double size) {
  double changed = 0, power = 0;
  for (const Experiment& each : recorded(simulation, flaw, size, 1, false)) {
    const Eigen::VectorXd own = simulation.run(inputOf(each), valuesOf(simulation));
    changed += (each.y - own).squaredNorm();
    power += (own.array() - own.mean()).square().sum();
  }
  return changed / power;
}

double sizeOf(Simulation& simulation, const Flaw& flaw) {
  double low = 0, high = 10;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high);
    (shareOf(simulation, flaw, middle) < kShare ? low : high) = middle;
  }
  return high;
}

std::string firstOf(const OwnSimulationFindings& found) {
  if (found.has_curve_in_front || found.curveLeads()) return found.structure.causes[0].what.name;
  if (!found.causes.empty() && found.causes[0].name == "sim_parameter")
    return "parameter:" + found.causes[0].parameter;
  if (!found.causes.empty()) return found.causes[0].name;
  return found.structure.causes.empty() ? "nothing" : found.structure.causes[0].what.name;
}

bool isAmong(const std::string& name, const std::vector<std::string>& accepted) {
  for (const std::string& each : accepted)
    if (each == name) return true;
  return false;
}

bool isAnywhere(const OwnSimulationFindings& found, const std::vector<std::string>& accepted) {
  for (const OwnCause& cause : found.causes)
    if (isAmong(cause.name == "sim_parameter" ? "parameter:" + cause.parameter : cause.name,
                accepted))
      return true;
  for (const SimulationCause& cause : found.structure.causes) {
    if (isAmong(cause.what.name, accepted)) return true;
    for (const PlaceAndShape& tie : cause.ties)
      if (isAmong(tie.name, accepted)) return true;
  }
  return false;
}

OwnSimulationFindings examined(Simulation& simulation, std::vector<Experiment> experiments) {
  const std::vector<Experiment> held(experiments.end() - kHeld, experiments.end());
  experiments.resize(experiments.size() - kHeld);
  return examine(simulation, experiments, held, {});
}

OwnSimulationFindings examinedAsColumn(Simulation& simulation,
                                       std::vector<Experiment> experiments) {
  for (Experiment& each : experiments)
    each.signals["y_sim"] = simulation.run(inputOf(each), valuesOf(simulation));
  return examined(*makeLoggedSimulation("y_sim", "the column"), experiments);
}

Flaw ofParameter(const std::string& name, int index, std::vector<std::string> also) {
  also.push_back("parameter:" + name);
  return {name, also, index, {}, {}};
}

std::vector<Flaw> commonFlaws() {
  const auto each = [](const std::function<double(double x, double size)>& curve) {
    return [curve](const Eigen::VectorXd& signal, double size) {
      return Eigen::VectorXd(signal.unaryExpr([&](double x) { return curve(x, size); }));
    };
  };
  const auto sign = [](double x) { return x < 0 ? -1.0 : 1.0; };
  const Curve late = [](const Eigen::VectorXd& y, double size) {
    Eigen::VectorXd delayed = y;
    for (Eigen::Index k = 0; k < y.size(); ++k) {
      const double at = std::max(0.0, static_cast<double>(k) - 10 * size);
      const auto left = static_cast<Eigen::Index>(at);
      const double share = at - static_cast<double>(left);
      delayed[k] = (1 - share) * y[left] + share * y[std::min(left + 1, y.size() - 1)];
    }
    return delayed;
  };
  return {
      {"output gain", {"sim_gain", "parameter:gain"}, -1, {}, each([](double y, double size) {
         return (1 + size) * y;
       })},
      {"delay", {"sim_delay"}, -1, {}, late},
      {"offset", {"sim_offset"}, -1, {}, each([](double y, double size) { return y + size; })},
      {"dead zone",
       {"act_deadzone"},
       -1,
       each([sign](double u, double size) { return sign(u) * std::max(std::abs(u) - size, 0.0); }),
       {}},
      {"saturation",
       {"act_saturation"},
       -1,
       each([sign](double u, double size) {
         return sign(u) * std::min(std::abs(u), 3 / (1e-3 + size));
       }),
       {}},
      {"asymmetry",
       {"act_asymmetry"},
       -1,
       each([](double u, double size) { return u > 0 ? u : u / (1 + size); }),
       {}},
      {"cubic sensor", {"sens_wiener", "sens_curve"}, -1, {}, each([](double y, double size) {
         return y + size * y * y * y;
       })},
      {"drifting gain",
       {"plant_drift"},
       -1,
       [](const Eigen::VectorXd& u, double size) {
         return Eigen::VectorXd(u.array() *
                                Eigen::ArrayXd::LinSpaced(u.size(), 1 - size / 2, 1 + size / 2));
       },
       {}}};
}

void measure(const char* way, Simulation& simulation, const std::vector<Flaw>& flaws, int seeds,
             const std::function<OwnSimulationFindings(std::vector<Experiment>)>& examine_it) {
  for (const Flaw& flaw : flaws) {
    const double size = sizeOf(simulation, flaw);
    int first = 0, anywhere = 0, within = 0, valued = 0;
    std::map<std::string, int> others;
    for (int seed = 1; seed <= seeds; ++seed) {
      const OwnSimulationFindings found =
          examine_it(recorded(simulation, flaw, size, static_cast<std::uint64_t>(seed), true));
      const bool is_first = isAmong(firstOf(found), flaw.accepted);
      first += is_first;
      anywhere += isAnywhere(found, flaw.accepted);
      if (!is_first) ++others[firstOf(found)];
      if (!is_first || flaw.parameter < 0) continue;
      const OwnValue& value = found.causes[0].values[0];
      ++valued;
      within += std::abs(value.measured - value.yours * (1 + size)) <= 2 * value.standard_error;
    }
    std::printf("%-28s %-16s %3d %3d of %d", way, flaw.name.c_str(), first, anywhere, seeds);
    if (valued > 0) std::printf("  within 2 standard errors %d of %d", within, valued);
    for (const auto& [name, count] : others) std::printf("  %s %d", name.c_str(), count);
    std::printf("\n");
    std::fflush(stdout);
  }
}

void measurePerfect(
    const char* way, Simulation& simulation, int seeds,
    const std::function<OwnSimulationFindings(std::vector<Experiment>)>& examine_it) {
  int named = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    MachineOptions options;
    options.seed = static_cast<std::uint64_t>(100 + seed);
    options.spread = seed % 2 == 0 ? 0.05 : 0;
    named += firstOf(examine_it(recordWithFactor(simulation, -1, 1, options))) != "nothing";
  }
  std::printf("%-28s %-16s %3d of %d named something\n", way, "perfect", named, seeds);
  std::fflush(stdout);
}

}  // namespace

int run(int seeds) {
  OwnModelOptions model;
  model.physical = {{"gain", 2.0}, {"omega1", 8.0}, {"zeta1", 0.4}};
  const auto second = makeLinearSimulation(factorsOf(model, MachineOptions().sample_time), "model");
  PendulumSimulation pendulum;
  std::vector<Flaw> of_second{ofParameter("gain", 0, {"sim_gain"}),
                              ofParameter("omega1", 1, {"sim_frequency"}),
                              ofParameter("zeta1", 2, {"sim_damping"})};
  std::vector<Flaw> of_pendulum{ofParameter("mass", 0, {"sim_gain", "sim_damping"}),
                                ofParameter("friction", 1, {"sim_damping"}),
                                ofParameter("length", 2, {"sim_frequency"})};
  for (const Flaw& each : commonFlaws()) {
    of_second.push_back(each);
    of_pendulum.push_back(each);
  }
  std::printf("way                          flaw             first, among those named\n");
  for (const auto& [name, simulation, flaws] :
       {std::make_tuple("model", static_cast<Simulation*>(second.get()), &of_second),
        std::make_tuple("pendulum", static_cast<Simulation*>(&pendulum), &of_pendulum)}) {
    Simulation& own = *simulation;
    const auto rerun = [&own](std::vector<Experiment> all) {
      return examined(own, std::move(all));
    };
    const auto column = [&own](std::vector<Experiment> all) {
      return examinedAsColumn(own, std::move(all));
    };
    const std::string as_column = std::string(name) + ", column";
    measure(name, own, *flaws, seeds, rerun);
    measurePerfect(name, own, 4 * seeds, rerun);
    measure(as_column.c_str(), own, *flaws, seeds, column);
    measurePerfect(as_column.c_str(), own, 4 * seeds, column);
  }
  return 0;
}

}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  return uncertainty_identification::run(argc > 1 ? std::atoi(argv[1]) : 5);
}
