// How often explain names what is wrong with a user's simulation (docs/own_simulation.md,
// Measured). usage: own_simulation_benchmark [SEEDS [FIRST_SEED [PERCENT [SIMULATION]]]]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "fmu/fmu_simulation.h"
#include "own_simulation/examine.h"
#include "own_simulation/linear_simulation.h"
#include "own_simulation/logged_simulation.h"
#include "support/fmu_builder.h"
#include "support/own_machine.h"
#include "support/temporary_folder.h"

namespace uncertainty_identification {
namespace {

constexpr int kHeld = 6;

struct Study {
  int seeds = 5;
  int first_seed = 1;
  double share = 0.05;     ///< of the output's variance that a flaw changes
  std::string simulation;  ///< "model", "pendulum" or "motor"; empty: all
  bool includes(const std::string& name) const { return simulation.empty() || simulation == name; }
};

using Curve = std::function<Eigen::VectorXd(const Eigen::VectorXd& signal, double size)>;

/// A flaw of a size that is chosen so that it changes Study::share of the variance.
struct Flaw {
  std::string name;
  std::vector<std::string> accepted;  ///< names, or "parameter:<name>"
  int parameter = -1;                 ///< multiplied by 1 + direction size
  Curve input, output;
  double direction = 1;
  double parameter_too = 0;  ///< the parameter is multiplied by 1 + this beside the curve

  double factor(double size) const {
    return 1 + (parameter_too != 0 ? parameter_too : direction * size);
  }
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
  return recordWithFactor(simulation, flaw.parameter, flaw.factor(size), options);
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

double sizeOf(Simulation& simulation, const Flaw& flaw, double share) {
  double low = 0, high = flaw.direction < 0 ? 0.95 : 10;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (low + high);
    (shareOf(simulation, flaw, middle) < share ? low : high) = middle;
  }
  return high;
}

std::string firstOf(const OwnSimulationFindings& found) {
  if (found.has_curve_around || found.curveLeads()) return found.structure.causes[0].what.name;
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

/// The parameter is higher, and lower.
void addParameter(const std::string& name, int index, std::vector<std::string> also,
                  std::vector<Flaw>* flaws) {
  also.push_back("parameter:" + name);
  flaws->push_back({name + " higher", also, index, {}, {}});
  flaws->push_back({name + " lower", also, index, {}, {}, -1});
}

/// What the truth itself leaves of the held-out data: fit [%] of the machine without noise.
double fitOfTruth(const std::vector<Experiment>& measured, const std::vector<Experiment>& clean) {
  double error = 0, sum = 0, squares = 0, count = 0;
  for (std::size_t k = measured.size() - kHeld; k < measured.size(); ++k) {
    error += (measured[k].y - clean[k].y).squaredNorm();
    sum += measured[k].y.sum();
    squares += measured[k].y.squaredNorm();
    count += static_cast<double>(measured[k].y.size());
  }
  return 100 * (1 - std::sqrt(error / (squares - sum * sum / count)));
}

double medianOf(std::vector<double> values) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

bool isWithinTwoErrors(const OwnSimulationFindings& found, double factor) {
  const OwnValue& value = found.causes[0].values[0];
  return std::abs(value.measured - value.yours * factor) <= 2 * value.standard_error;
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

using Way = std::function<OwnSimulationFindings(std::vector<Experiment>)>;

void measureFlaw(const std::string& way, Simulation& simulation, const Flaw& flaw,
                 const Study& study, const Way& examine_it) {
  const double size = sizeOf(simulation, flaw, study.share);
  int first = 0, anywhere = 0, within = 0, valued = 0;
  std::map<std::string, int> others;
  std::vector<double> gains;
  for (int k = 0; k < study.seeds; ++k) {
    const auto seed = static_cast<std::uint64_t>(study.first_seed + k);
    const std::vector<Experiment> measured = recorded(simulation, flaw, size, seed, true);
    const OwnSimulationFindings found = examine_it(measured);
    const double truth = fitOfTruth(measured, recorded(simulation, flaw, size, seed, false));
    gains.push_back((found.fit_after - found.fit_before) / (truth - found.fit_before));
    const bool is_first = isAmong(firstOf(found), flaw.accepted);
    first += is_first;
    anywhere += isAnywhere(found, flaw.accepted);
    if (!is_first) ++others[firstOf(found)];
    if (!is_first || flaw.parameter < 0 || found.causes.empty()) continue;
    ++valued;
    within += isWithinTwoErrors(found, flaw.factor(size));
  }
  std::printf("%-18s %-16s %3d %3d of %d  gain %3.0f %%", way.c_str(), flaw.name.c_str(), first,
              anywhere, study.seeds, 100 * medianOf(gains));
  if (valued > 0) std::printf("  within 2 standard errors %d of %d", within, valued);
  for (const auto& [name, count] : others) std::printf("  %s %d", name.c_str(), count);
  std::printf("\n");
  std::fflush(stdout);
}

/// A wrong parameter beside a dead zone: how often both are named.
void measurePair(const std::string& way, Simulation& simulation, const Flaw& dead_zone,
                 const Study& study, const Way& examine_it) {
  Flaw pair = dead_zone;
  pair.parameter = 0;
  pair.parameter_too = 0.15;
  const std::string name = simulation.parameters()[0].name;
  const double size = sizeOf(simulation, dead_zone, study.share);
  int both = 0;
  for (int k = 0; k < study.seeds; ++k) {
    const auto seed = static_cast<std::uint64_t>(study.first_seed + k);
    const OwnSimulationFindings found = examine_it(recorded(simulation, pair, size, seed, true));
    both += isAnywhere(found, pair.accepted) &&
            isAnywhere(found, {"parameter:" + name, "sim_gain", "sim_damping"});
  }
  std::printf("%-18s %s 15 %% higher and a dead zone: both named %d of %d\n", way.c_str(),
              name.c_str(), both, study.seeds);
  std::fflush(stdout);
}

void measurePerfect(const std::string& way, Simulation& simulation, const Study& study,
                    const Way& examine_it) {
  const int count = 5 * study.seeds;
  int named = 0;
  for (int k = 1; k <= count; ++k) {
    MachineOptions options;
    options.seed = static_cast<std::uint64_t>(100 + study.first_seed + k);
    options.spread = k % 2 == 0 ? 0.05 : 0;
    named += firstOf(examine_it(recordWithFactor(simulation, -1, 1, options))) != "nothing";
  }
  std::printf("%-18s perfect: %d of %d named something\n", way.c_str(), named, count);
  std::fflush(stdout);
}

/// All flaws of a simulation, in both ways in which it can be given.
void measure(const std::string& name, Simulation& own, const std::vector<Flaw>& flaws,
             const Study& study) {
  const Way rerun = [&own](std::vector<Experiment> all) { return examined(own, std::move(all)); };
  const Way column = [&own](std::vector<Experiment> all) {
    return examinedAsColumn(own, std::move(all));
  };
  for (const auto& [way, examine_it] : {std::pair(name, rerun), {name + ", column", column}}) {
    for (const Flaw& flaw : flaws) {
      measureFlaw(way, own, flaw, study, examine_it);
      if (flaw.name == "dead zone") measurePair(way, own, flaw, study, examine_it);
    }
    measurePerfect(way, own, study, examine_it);
  }
}

/// A motor with Coulomb friction as a functional mock-up unit.
void measureMotor(const Study& study) {
  const TemporaryFolder folder;
  const std::string path = folder / "motor.fmu";
  test::buildFmu(path, {});
  const auto motor = loadFmu(
      path, {"voltage", "speed", {{"constant", 0.5}, {"friction", 0.15}, {"inertia", 0.02}}, 10});
  const std::vector<SimulationParameter> parameters = motor->parameters();
  const std::map<std::string, std::vector<std::string>> also{
      {"constant", {"sim_gain"}},
      {"friction", {"plant_coulomb", "act_deadzone"}},
      {"inertia", {"sim_time_constant", "sim_time_constants"}}};
  std::vector<Flaw> flaws;
  for (std::size_t k = 0; k < parameters.size(); ++k)
    addParameter(parameters[k].name, static_cast<int>(k), also.at(parameters[k].name), &flaws);
  for (const Flaw& each : commonFlaws()) flaws.push_back(each);
  measure("motor (FMU)", *motor, flaws, study);
}

}  // namespace

int run(const Study& study) {
  OwnModelOptions model;
  model.physical = {{"gain", 2.0}, {"omega1", 8.0}, {"zeta1", 0.4}};
  const auto second = makeLinearSimulation(factorsOf(model, MachineOptions().sample_time), "model");
  PendulumSimulation pendulum;
  std::vector<Flaw> of_second, of_pendulum;
  addParameter("gain", 0, {"sim_gain"}, &of_second);
  addParameter("omega1", 1, {"sim_frequency"}, &of_second);
  addParameter("zeta1", 2, {"sim_damping"}, &of_second);
  addParameter("mass", 0, {"sim_gain", "sim_damping"}, &of_pendulum);
  addParameter("friction", 1, {"sim_damping"}, &of_pendulum);
  addParameter("length", 2, {"sim_frequency"}, &of_pendulum);
  for (const Flaw& each : commonFlaws()) {
    of_second.push_back(each);
    of_pendulum.push_back(each);
  }
  std::printf(
      "way                flaw             first, among those named; median share of what "
      "the truth gains\n");
  if (study.includes("model")) measure("model", *second, of_second, study);
  if (study.includes("pendulum")) measure("pendulum", pendulum, of_pendulum, study);
  if (study.includes("motor")) measureMotor(study);
  return 0;
}

}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  uncertainty_identification::Study study;
  if (argc > 1) study.seeds = std::atoi(argv[1]);
  if (argc > 2) study.first_seed = std::atoi(argv[2]);
  if (argc > 3) study.share = std::atof(argv[3]) / 100;
  if (argc > 4) study.simulation = argv[4];
  if (!study.includes("model") && !study.includes("pendulum") && !study.includes("motor")) {
    std::fprintf(stderr, "there is no simulation '%s': model, pendulum or motor\n", argv[4]);
    return 2;
  }
  return uncertainty_identification::run(study);
}
