#include "study/system.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace uncertainty_identification::study {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXd;

namespace {

constexpr double kPi = 3.141592653589793;

/// Purposes of the streams of random numbers of a system.
enum Purpose : std::uint64_t { kDesign = 1, kMembers, kSignals, kFresh, kScale };

VectorXd deadZone(double half_width, const VectorXd& u) {
  return u.unaryExpr([half_width](double value) {
    return value > half_width ? value - half_width
                              : (value < -half_width ? value + half_width : 0.0);
  });
}

VectorXd outputOf(const System& system, const Member& member, const VectorXd& u) {
  const SampledPlant plant(member.plant, system.family.sample_time);
  return plant.simulate(deadZone(member.dead_zone * system.input.amplitude, u));
}

double deviationOf(const VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

NoiseKind drawNoiseKind(Kind kind, Draw& draw) {
  if (kind == Kind::heavy_tails) return NoiseKind::heavy_tailed;
  if (kind == Kind::away_from_rest) return NoiseKind::coloured;
  return static_cast<NoiseKind>(draw.index({0.45, 0.4, 0.15}));
}

bool hasDeadZone(const Family& family) {
  return family.kind == Kind::inexpressible && !family.structure_varies;
}

/// The gain of a dead zone's best linear approximation, by Bussgang's theorem exact for Gaussian
/// inputs: E[f(u) u]/E[u^2].
double gainOf(double half_width, const VectorXd& u) {
  return half_width > 0 ? deadZone(half_width, u).dot(u) / u.squaredNorm() : 1.0;
}

}  // namespace

System drawSystem(Kind kind, int experiments, int most_samples, std::uint64_t seed) {
  System system;
  system.seed = seed * 100 + static_cast<std::uint64_t>(kind);
  Draw draw(seedOf(system.seed, kDesign));
  system.experiments = experiments;
  system.samples = static_cast<int>(draw.logUniform(50, 1000));
  system.samples = std::max(50, std::min(system.samples, most_samples / experiments));
  system.family = drawFamily(kind, system.samples, draw);
  system.input = drawInput(system.family.slowest, system.samples, draw);
  if (hasDeadZone(system.family))
    system.input.kind = InputKind::noise;  // Gaussian, for Bussgang's theorem
  system.noise = drawNoise(drawNoiseKind(kind, draw), draw);
  Draw scale(seedOf(system.seed, kScale));
  const double signal = deviationOf(
      outputOf(system, system.family.center, drawSignal(system.input, system.samples, scale)));
  system.noise_deviation = signal * draw.logUniform(0.01, 0.3);
  if (kind == Kind::away_from_rest) {
    system.offset = signal * draw.uniform(-5, 5);
    system.run_up = static_cast<int>(10 * system.family.slowest) + 20;
  }
  return system;
}

std::vector<Experiment> measure(const System& system) {
  Draw members(seedOf(system.seed, kMembers)), signals(seedOf(system.seed, kSignals));
  std::vector<Experiment> experiments;
  for (int r = 0; r < system.experiments; ++r) {
    const Member member = drawMember(system.family, members);
    const VectorXd u = drawSignal(system.input, system.run_up + system.samples, signals);
    const VectorXd noise = drawNoiseSignal(system.noise, system.samples, signals);
    Experiment experiment;
    experiment.id = "experiment" + std::to_string(r);
    experiment.sample_time = system.family.sample_time;
    experiment.u = u.tail(system.samples);
    experiment.y = outputOf(system, member, u).tail(system.samples);
    experiment.y.array() += system.noise_deviation * noise.array() + system.offset;
    experiments.push_back(experiment);
  }
  return experiments;
}

VectorXd excitedFrequencies(const System& system) {
  constexpr int kFrequencies = 40;
  const double nyquist = kPi / system.family.sample_time;
  double top = 0.8;
  if (system.input.kind == InputKind::multisine) top = std::min(top, system.input.top);
  return VectorXd::LinSpaced(kFrequencies, std::log(2 * nyquist / system.samples),
                             std::log(top * nyquist))
      .array()
      .exp();
}

MatrixXcd freshResponses(const System& system, int plants, const VectorXd& omega) {
  constexpr int kLongRecord = 20000;
  Draw draw(seedOf(system.seed, kFresh));
  const VectorXd u = drawSignal(system.input, hasDeadZone(system.family) ? kLongRecord : 1, draw);
  MatrixXcd all(plants, omega.size());
  for (Index r = 0; r < plants; ++r) {
    const Member member = drawMember(system.family, draw);
    all.row(r) = SampledPlant(member.plant, system.family.sample_time).responses(omega).transpose();
    all.row(r) *= gainOf(member.dead_zone * system.input.amplitude, u);
  }
  return all;
}

}  // namespace uncertainty_identification::study
