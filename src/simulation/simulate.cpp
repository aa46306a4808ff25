#include "uncertainty_identification/simulation/simulate.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "uncertainty_identification/model/error_basis.h"
#include "uncertainty_identification/model/filter.h"
#include "uncertainty_identification/model/polynomial.h"
#include "uncertainty_identification/simulation/input.h"
#include "uncertainty_identification/simulation/random_stream.h"

namespace uncertainty_identification {
namespace {

constexpr double kFirstStart = 1.0;  // [s]; bags refuse a stamp of zero
constexpr int kPause = 10;           // [samples] between experiments

// The filters of the model work on blocks; a simulated signal is one lane of them.
Signals asBlock(const Eigen::VectorXd& signal) {
  Signals block = Signals::Zero(kLanes, signal.size());
  block.row(0) = signal.array();
  return block;
}

Eigen::VectorXd filtered(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator,
                         int delay, const Eigen::VectorXd& signal) {
  Signals out;
  filter(numerator, denominator, delay, asBlock(signal), &out);
  return out.row(0).matrix();
}

Eigen::VectorXd drawFrom(const Mixture& mixture, std::mt19937_64& random, int* component) {
  std::discrete_distribution<int> pick(mixture.weights.begin(), mixture.weights.end());
  *component = pick(random);
  const auto i = static_cast<std::size_t>(*component);
  // A root that exists for singular covariances too.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(mixture.covariances[i]);
  const Eigen::VectorXd scale = eigen.eigenvalues().cwiseMax(0).cwiseSqrt();
  return mixture.means[i] +
         eigen.eigenvectors() * scale.cwiseProduct(gaussian(mixture.dimension(), 1, random));
}

double drawTimeConstant(const PlantTruth& plant, std::mt19937_64& random) {
  std::uniform_real_distribution<double> relative(-plant.time_constant_spread,
                                                  plant.time_constant_spread);
  return plant.time_constant * (1 + relative(random));
}

// Zero-order hold of gain/(1 + tau s), equation (39).
Polynomials firstOrder(const PlantTruth& plant, double time_constant, double sample_time) {
  const double pole = std::exp(-sample_time / time_constant);
  Polynomials polynomials;
  polynomials.delay = plant.delay;
  polynomials.b = Eigen::VectorXd::Constant(1, plant.gain * (1 - pole));
  polynomials.a = Eigen::VectorXd::Constant(1, -pole);
  return polynomials;
}

// Go (1 + GDelta) u, equation (2), from rest.
Eigen::VectorXd plantOutput(const Truth& truth, const DrawnSystem& system,
                            const Eigen::VectorXd& u) {
  const Polynomials& plant = system.polynomials;
  const Eigen::VectorXd nominal = filtered(plant.b, plant.a, plant.delay, u);
  if (system.component < 0) return nominal;
  std::vector<Signals> regressors;
  ErrorBasis(truth.error_model.basis).apply(asBlock(nominal), &regressors);
  Eigen::VectorXd output = nominal;
  for (std::size_t i = 0; i < regressors.size(); ++i) {
    output += system.xi(static_cast<Eigen::Index>(i)) * regressors[i].row(0).matrix().transpose();
  }
  return output;
}

// Samples after which what was there before has died away to rounding.
int warmUp(const NoiseTruth& noise) {
  if (noise.start == NoiseStart::zero) return 0;
  const double slowest = noise.d.size() == 0 ? 0 : roots(noise.d).cwiseAbs().maxCoeff();
  const double decay =
      slowest > 0 ? std::log(std::numeric_limits<double>::epsilon()) / std::log(slowest) : 0;
  return static_cast<int>(noise.c.size() + noise.d.size()) +
         static_cast<int>(std::min(std::ceil(decay), 1e7));
}

Eigen::VectorXd outputNoise(const NoiseTruth& noise, int samples, std::mt19937_64& random) {
  const Eigen::VectorXd innovations = gaussian(warmUp(noise) + samples, noise.variance, random);
  return filtered(withLeadingOne(noise.c), noise.d, 0, innovations).tail(samples);
}

void loseSamples(const SensorTruth& sensor, std::mt19937_64& random, Experiment* experiment) {
  if (sensor.missing == 0) return;
  std::bernoulli_distribution lost(sensor.missing);
  experiment->valid.assign(static_cast<std::size_t>(experiment->samples()), 1);
  for (int k = 0; k < experiment->samples(); ++k) {
    if (!lost(random)) continue;
    experiment->valid[static_cast<std::size_t>(k)] = 0;
    experiment->y(k) = std::numeric_limits<double>::quiet_NaN();
  }
}

double startTime(const Truth& truth, int r) {
  double samples = 0;
  if (truth.samples.size() == 1) {
    samples = static_cast<double>(r) * (truth.samples.front() + kPause);
  } else {
    for (int s = 0; s < r; ++s) samples += truth.samplesOf(s) + kPause;
  }
  return kFirstStart + samples * truth.sample_time;
}

}  // namespace

std::string experimentId(int r) {
  char id[32];
  std::snprintf(id, sizeof id, "exp_%06d", r);
  return id;
}

DrawnSystem drawSystem(const Truth& truth, std::uint64_t seed, int r) {
  std::mt19937_64 random = randomStream(seed, r, RandomPurpose::system);
  DrawnSystem system;
  if (truth.plant.structure == PlantStructure::first_order) {
    system.time_constant = drawTimeConstant(truth.plant, random);
    system.polynomials = firstOrder(truth.plant, system.time_constant, truth.sample_time);
  } else {
    system.polynomials.delay = truth.plant.delay;
    system.polynomials.b = truth.plant.b;
    system.polynomials.a = truth.plant.a;
  }
  system.polynomials.c = truth.noise.c;
  system.polynomials.d = truth.noise.d;
  const Mixture& mixture = truth.error_model.mixture;
  if (mixture.components() > 0) system.xi = drawFrom(mixture, random, &system.component);
  return system;
}

Experiment simulateExperiment(const Truth& truth, std::uint64_t seed, int r) {
  const auto stream = [seed, r](RandomPurpose purpose) { return randomStream(seed, r, purpose); };
  std::mt19937_64 input = stream(RandomPurpose::input);
  std::mt19937_64 noise = stream(RandomPurpose::noise);
  std::mt19937_64 missing = stream(RandomPurpose::missing);
  const int samples = truth.samplesOf(r);

  Experiment experiment;
  experiment.id = experimentId(r);
  experiment.sample_time = truth.sample_time;
  experiment.start_time = startTime(truth, r);
  experiment.u = makeInput(truth.input, samples, input);
  experiment.y = plantOutput(truth, drawSystem(truth, seed, r), experiment.u) +
                 outputNoise(truth.noise, samples, noise);
  loseSamples(truth.sensor, missing, &experiment);
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
