#include "simulation/simulate.h"

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "simulation/chain.h"
#include "simulation/input.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

constexpr double kFirstStart = 1.0;  // [s]; a bag refuses a time stamp of zero
constexpr int kPause = 10;           // [samples] between experiments

double startTime(const Truth& truth, int r) {
  double samples = 0;
  if (truth.samples.size() == 1) {
    samples = static_cast<double>(r) * (truth.samples.front() + kPause);
  } else {
    for (int s = 0; s < r; ++s) samples += truth.samplesOf(s) + kPause;
  }
  return kFirstStart + samples * truth.sample_time;
}

/// Deviations [s] of the sampling times from an even spacing. The first is not negative, because
/// the record begins with it.
VectorXd stampOffset(const Truth& truth, int samples, std::mt19937_64 random) {
  const double width = truth.effects.experiment.jitter->width * truth.sample_time;
  std::uniform_real_distribution<double> uniform(-width, width);
  VectorXd offset = VectorXd::NullaryExpr(samples, [&] { return uniform(random); });
  offset(0) = std::abs(offset(0));
  return offset;
}

/// Experiment r without its signals u and y, which are simulated from this.
Experiment prepare(const Truth& truth, std::uint64_t seed, int r) {
  const auto stream = [seed, r](RandomPurpose purpose) { return randomStream(seed, r, purpose); };
  const int samples = truth.samplesOf(r);
  Experiment experiment;
  experiment.id = experimentId(r);
  experiment.sample_time = truth.sample_time;
  experiment.start_time = startTime(truth, r);
  if (truth.covariates.temp || truth.effects.plant.temp)
    experiment.signals["temp"] = temperature(samples, stream(RandomPurpose::temperature));
  if (truth.covariates.d || truth.effects.experiment.input2)
    experiment.signals["d"] = secondInput(samples, stream(RandomPurpose::second_input));
  if (truth.effects.experiment.jitter)
    experiment.stamp_offset = stampOffset(truth, samples, stream(RandomPurpose::jitter));
  return experiment;
}

/// The input of experiment r, or its reference r when it runs in closed loop.
VectorXd reference(const ChainContext& context, int samples) {
  const InputTruth& input = context.truth.input;
  std::mt19937_64 random = context.stream(RandomPurpose::input);
  const VectorXd signal = makeInput(input, samples, random);
  if (input.amplitude_spread == 0) return signal;
  std::mt19937_64 amplitude = context.stream(RandomPurpose::amplitude);
  const double spread = input.amplitude_spread;
  return std::uniform_real_distribution<double>(1 - spread, 1 + spread)(amplitude) * signal;
}

/// Solves u(t) = r(t) - gain y(t - 1) by iteration. y(t - 1) depends only on u up to t - 1, so that
/// every pass makes at least one more sample of u final.
VectorXd closedLoopInput(const ChainContext& context, const VectorXd& reference) {
  const double gain = context.truth.effects.experiment.feedback->gain;
  const Eigen::Index samples = reference.size();
  VectorXd u = reference;
  for (Eigen::Index pass = 0; pass < samples; ++pass) {
    const VectorXd x = plantOutput(context, u),
                   y = measured(context, x, outputNoise(context, u, x));
    VectorXd next = reference;
    next.tail(samples - 1) -= gain * y.head(samples - 1);
    if (next == u) break;
    u = next;
  }
  return u;
}

/// Marks outputs as not measured.
void loseSamples(const SensorTruth& sensor, std::mt19937_64 random, Experiment* experiment) {
  if (sensor.missing == 0) return;
  std::bernoulli_distribution lost(sensor.missing);
  experiment->valid.assign(static_cast<std::size_t>(experiment->samples()), 1);
  for (int k = 0; k < experiment->samples(); ++k) {
    if (!lost(random)) continue;
    experiment->valid[static_cast<std::size_t>(k)] = 0;
    experiment->y(k) = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

std::string experimentId(int r) {
  char id[32];
  std::snprintf(id, sizeof id, "exp_%06d", r);
  return id;
}

Experiment simulateExperiment(const Truth& truth, std::uint64_t seed, int r) {
  Experiment experiment = prepare(truth, seed, r);
  const DrawnSystem system = drawSystem(truth, seed, r);
  const ChainContext context{truth, system, experiment, seed, r};
  const VectorXd drawn = reference(context, truth.samplesOf(r));
  experiment.u = truth.effects.experiment.feedback ? closedLoopInput(context, drawn) : drawn;
  const VectorXd x = sampledOutput(context, plantOutput(context, experiment.u));
  experiment.y = measured(context, x, outputNoise(context, experiment.u, x));
  if (!experiment.y.allFinite()) {
    throw ConfigurationError("effects: they make the output of " + experiment.id +
                             " diverge; allowed: smaller ones");
  }
  loseSamples(truth.sensor, context.stream(RandomPurpose::missing), &experiment);
  return experiment;
}

std::vector<Experiment> simulate(const Truth& truth, std::uint64_t seed) {
  truth.validate();
  std::vector<Experiment> experiments;
  experiments.reserve(static_cast<std::size_t>(truth.experiments));
  for (int r = 0; r < truth.experiments; ++r)
    experiments.push_back(simulateExperiment(truth, seed, r));
  return experiments;
}

}  // namespace uncertainty_identification
