#include "support/hidden_effects/random_truth.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "configuration/require.h"
#include "math/polynomial.h"
#include "simulation/simulate.h"
#include "support/hidden_effects/draw.h"

namespace uncertainty_identification::test {
namespace {

using Complex = std::complex<double>;
using Eigen::VectorXd;

/// A complex pair, or two real poles that differ by at least 0.15.
std::vector<Complex> twoPoles(std::mt19937_64& random) {
  if (chance(0.5, random)) {
    const Complex pole = std::polar(uniform(0.6, 0.93, random), uniform(0.15, 1.2, random));
    return {pole, std::conj(pole)};
  }
  const double slow = uniform(0.7, 0.95, random);
  return {slow, uniform(0.3, slow - 0.15, random)};
}

std::vector<Complex> drawPoles(int order, std::mt19937_64& random) {
  if (order == 1) return {uniform(0.5, 0.95, random)};
  std::vector<Complex> poles = twoPoles(random);
  if (order == 3) poles.emplace_back(uniform(-0.3, 0.4, random));
  return poles;
}

/// The product of all (1 - root q^-1), without its leading 1.
VectorXd fromRoots(const std::vector<Complex>& roots) {
  Eigen::VectorXcd polynomial = Eigen::VectorXcd::Zero(static_cast<Eigen::Index>(roots.size()) + 1);
  polynomial(0) = 1;
  for (const Complex root : roots) {
    for (Eigen::Index k = polynomial.size() - 1; k > 0; --k)
      polynomial(k) -= root * polynomial(k - 1);
  }
  return polynomial.real().tail(polynomial.size() - 1);
}

bool isNear(double zero, const std::vector<Complex>& poles) {
  return std::any_of(poles.begin(), poles.end(),
                     [zero](const Complex pole) { return std::abs(pole - zero) < 0.15; });
}

void drawPlant(std::mt19937_64& random, PlantTruth* plant) {
  const int order = whole(1, 3, random);
  const std::vector<Complex> poles = drawPoles(order, random);
  std::vector<Complex> zeros;
  const int zero_count = whole(0, order - 1, random);
  while (static_cast<int>(zeros.size()) < zero_count) {
    const double zero = uniform(-0.7, 0.6, random);
    if (!isNear(zero, poles)) zeros.emplace_back(zero);
  }
  plant->a = fromRoots(poles);
  plant->b = withLeadingOne(fromRoots(zeros));
  plant->b *= logUniform(0.5, 3, random) * (1 + plant->a.sum()) / plant->b.sum();
}

void drawNoiseModel(std::mt19937_64& random, NoiseTruth* noise) {
  noise->start = NoiseStart::stationary;
  if (chance(0.5, random)) return;  // the model is output error
  const double pole = signedUniform(0.3, 0.9, random), zero = signedUniform(0.2, 0.7, random);
  noise->d = VectorXd::Constant(1, -pole);
  if (chance(0.5, random) && std::abs(pole - zero) > 0.3) noise->c = VectorXd::Constant(1, -zero);
}

void drawErrorModel(std::mt19937_64& random, ErrorModelTruth* error_model) {
  const int dimension = whole(1, 2, random), components = whole(1, 3, random);
  error_model->basis.taps = dimension + 1;
  error_model->basis.components = components;
  const double deviation = uniform(0.03, 0.05, random), apart = uniform(0.3, 0.5, random);
  const VectorXd direction = directionOf(dimension, random);
  const VectorXd centre = 0.1 * gaussian(dimension, 1, random);
  for (int i = 0; i < components; ++i) {
    error_model->mixture.weights.push_back(uniform(0.75, 1.25, random));
    error_model->mixture.means.push_back(centre + apart * (i - 0.5 * (components - 1)) * direction);
    error_model->mixture.covariances.push_back(deviation * deviation *
                                               Eigen::MatrixXd::Identity(dimension, dimension));
  }
  double sum = 0;
  for (const double weight : error_model->mixture.weights) sum += weight;
  for (double& weight : error_model->mixture.weights) weight /= sum;
}

void drawInput(int samples, std::mt19937_64& random, InputTruth* input) {
  input->kind = static_cast<InputKind>(whole(0, 3, random));
  input->variance = logUniform(0.25, 4, random);
  if (input->kind == InputKind::white_noise) input->hold = whole(1, 3, random);
  if (input->kind == InputKind::prbs) input->hold = whole(2, 10, random);
  if (input->kind == InputKind::steps) input->hold = whole(5, 30, random);
  input->tones = std::min(whole(10, 60, random), (samples - 1) / 2);
  if (chance(0.5, random)) input->amplitude_spread = 0.5;
}

/// Variance of C/D w, divided by the variance of w.
double noiseGain(const NoiseTruth& noise) {
  const int samples = 1000;
  VectorXd response = VectorXd::Zero(samples);
  const VectorXd c = withLeadingOne(noise.c);
  for (Eigen::Index k = 0; k < samples; ++k) {
    if (k < c.size()) response(k) = c(k);
    for (Eigen::Index i = 0; i < std::min(k, noise.d.size()); ++i)
      response(k) -= noise.d(i) * response(k - 1 - i);
  }
  return response.squaredNorm();
}

}  // namespace

void RandomTruthOptions::validate() const {
  requireRange("experiments", experiments, 1, 1000000);
  requireRange("samples", samples, 30, 1000000);
}

Truth randomTruth(const RandomTruthOptions& options, std::mt19937_64& random) {
  options.validate();
  Truth truth;
  truth.experiments = options.experiments;
  truth.samples = {options.samples};
  truth.covariates.temp = truth.covariates.d = true;
  drawPlant(random, &truth.plant);
  drawNoiseModel(random, &truth.noise);
  drawErrorModel(random, &truth.error_model);
  drawInput(options.samples, random, &truth.input);
  const double ratio = std::pow(10, uniform(20, 30, random) / 10);
  const double y = signalScale(truth, random()).y;
  truth.noise.variance = y * y / ratio / noiseGain(truth.noise);
  return truth;
}

Configuration declaredSimulation(const Truth& truth) {
  Configuration configuration;
  configuration.sample_time = truth.sample_time;
  NominalModelOptions& model = configuration.nominal_model;
  model.orders_auto = false;
  model.nb = static_cast<int>(truth.plant.b.size());
  model.na = static_cast<int>(truth.plant.a.size());
  model.nc = static_cast<int>(truth.noise.c.size());
  model.nd = static_cast<int>(truth.noise.d.size());
  if (truth.plant.structure == PlantStructure::first_order) model.nb = model.na = 1;
  model.delay = truth.plant.delay;
  model.structure = model.nc + model.nd > 0 ? Structure::box_jenkins : Structure::output_error;
  configuration.error_model = truth.error_model.basis;
  configuration.error_model.components = truth.error_model.mixture.components();
  configuration.estimation.initial_state = InitialState::zero;
  configuration.estimation.offsets = Offsets::none;
  configuration.estimation.noise_start = NoiseStart::stationary;
  configuration.bounds.frequencies = 0;
  return configuration;
}

SignalScale signalScale(Truth truth, std::uint64_t seed) {
  truth.noise.variance = 0;
  SignalScale scale;
  double count = 0;
  for (const Experiment& experiment : simulate(truth, seed)) {
    const Eigen::Index n = experiment.samples();
    scale.u += experiment.u.squaredNorm();
    scale.y += experiment.y.squaredNorm();
    scale.u_max = std::max(scale.u_max, experiment.u.cwiseAbs().maxCoeff());
    scale.y_max = std::max(scale.y_max, experiment.y.cwiseAbs().maxCoeff());
    const VectorXd change = experiment.u.tail(n - 1) - experiment.u.head(n - 1);
    scale.u_step = std::max(scale.u_step, change.cwiseAbs().maxCoeff());
    count += static_cast<double>(n);
  }
  scale.u = std::sqrt(scale.u / count);
  scale.y = std::sqrt(scale.y / count);
  return scale;
}

}  // namespace uncertainty_identification::test
