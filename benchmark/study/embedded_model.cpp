#include "study/embedded_model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <string>

namespace uncertainty_identification::study {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

using Roots = std::vector<std::complex<double>>;

Roots drawRoots(int count, double radius, Draw& draw) {
  Roots roots;
  while (static_cast<int>(roots.size()) < count) {
    const double size = draw.uniform(0.3, radius);
    if (static_cast<int>(roots.size()) + 1 < count && draw.chance(0.4)) {
      const double angle = draw.uniform(0.2, 1.5);
      roots.push_back(std::polar(size, angle));
      roots.push_back(std::polar(size, -angle));
    } else {
      roots.emplace_back(draw.chance(0.85) ? size : -size, 0.0);
    }
  }
  return roots;
}

double smallestDistance(const Roots& roots) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < roots.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, std::abs(roots[i] - roots[j]));
  }
  return least;
}

/// Two sets of roots, all at least 0.15 apart.
std::pair<Roots, Roots> drawApart(int first, double first_radius, int second, double second_radius,
                                  Draw& draw) {
  while (true) {
    const Roots one = drawRoots(first, first_radius, draw);
    const Roots other = drawRoots(second, second_radius, draw);
    Roots all = one;
    all.insert(all.end(), other.begin(), other.end());
    if (smallestDistance(all) >= 0.15) return {one, other};
  }
}

/// Coefficients of the monic polynomial in q^-1, without the leading 1.
VectorXd polynomialOf(const Roots& roots) {
  std::vector<std::complex<double>> full = {1.0};
  for (const std::complex<double>& root : roots) {
    full.push_back(0.0);
    for (std::size_t k = full.size() - 1; k > 0; --k) full[k] -= root * full[k - 1];
  }
  VectorXd tail(static_cast<Index>(roots.size()));
  for (Index k = 0; k < tail.size(); ++k) tail[k] = full[static_cast<std::size_t>(k) + 1].real();
  return tail;
}

/// The recursion of (lead + tail q^-1 + ...)/(1 + denominator) from rest.
VectorXd filtered(double lead, const VectorXd& tail, const VectorXd& denominator,
                  const VectorXd& input) {
  VectorXd output = VectorXd::Zero(input.size());
  for (Index t = 0; t < input.size(); ++t) {
    output[t] = lead * input[t];
    for (Index k = 0; k < std::min(tail.size(), t); ++k) output[t] += tail[k] * input[t - 1 - k];
    for (Index k = 0; k < std::min(denominator.size(), t); ++k)
      output[t] -= denominator[k] * output[t - 1 - k];
  }
  return output;
}

/// Means three standard deviations apart in at least one direction.
Mixture drawMixture(int dimension, int components, Draw& draw) {
  Mixture mixture;
  for (int i = 0; i < components; ++i) {
    mixture.weights.push_back(draw.uniform(0.5, 1));
    MatrixXd root = MatrixXd::NullaryExpr(dimension, dimension, [&]() { return draw.normal(); });
    mixture.covariances.push_back(0.01 * root * root.transpose() +
                                  0.01 * MatrixXd::Identity(dimension, dimension));
  }
  const double total = std::accumulate(mixture.weights.begin(), mixture.weights.end(), 0.0);
  for (double& weight : mixture.weights) weight /= total;
  for (int i = 0; i < components;) {
    const VectorXd mean = 0.6 * draw.normals(dimension);
    bool apart = true;
    for (int j = 0; j < i; ++j) {
      const auto at = static_cast<std::size_t>(j);
      const VectorXd away = mean - mixture.means[at];
      const MatrixXd& one = mixture.covariances[at];
      const MatrixXd& other = mixture.covariances[static_cast<std::size_t>(i)];
      const double deviation = std::sqrt(away.dot((one + other) * away) / 2) / away.norm();
      apart = apart && away.norm() >= 3 * deviation;
    }
    if (!apart) continue;
    mixture.means.push_back(mean);
    ++i;
  }
  return mixture;
}

VectorXd drawInput(const EmbeddedModel& model, Draw& draw) {
  VectorXd white = draw.normals(model.samples);
  if (model.binary) return white.array().sign();
  return std::sqrt(1 - model.input_pole * model.input_pole) *
         filtered(1, VectorXd(), VectorXd::Constant(1, -model.input_pole), white);
}

VectorXd noiseFreeOutput(const EmbeddedModel& model, const VectorXd& u) {
  if (model.plant.time_constants.empty()) return filtered(0, model.b, model.a, u);
  return SampledPlant(model.plant, 1).simulate(u);
}

/// (1 + GDelta) u for a plant drawn from the mixture.
VectorXd perturbed(const EmbeddedModel& model, const VectorXd& u, Draw& draw) {
  if (model.taps < 2) return u;
  const auto i = static_cast<std::size_t>(draw.index(model.mixture.weights));
  const MatrixXd root = model.mixture.covariances[i].llt().matrixL();
  const VectorXd xi = model.mixture.means[i] + root * draw.normals(model.taps - 1);
  VectorXd tail(model.taps - 1);  // eta of the taps q^-1, q^-2, ...
  tail.head(model.taps - 2) = xi.tail(model.taps - 2);
  tail[model.taps - 2] = -xi.sum();
  return u + filtered(xi[0], tail, VectorXd(), u);
}

/// What does not depend on the kind of plant.
void drawRest(const EmbeddedModelSize& size, Draw& draw, EmbeddedModel* model) {
  const auto noise = drawApart(size.nc, 0.9, size.nd, 0.9, draw);
  model->c = polynomialOf(noise.first);
  model->d = polynomialOf(noise.second);
  model->taps = size.taps;
  if (size.taps >= 2) model->mixture = drawMixture(size.taps - 1, size.components, draw);
  model->samples = size.samples;
  model->input_pole = draw.uniform(0, 0.6);
  model->binary = draw.chance(0.3);
  model->gaps = draw.chance(0.1);
  Draw scale(1);
  const VectorXd y = noiseFreeOutput(*model, drawInput(*model, scale));
  model->noise_variance = y.squaredNorm() / size.samples * std::pow(draw.logUniform(0.02, 0.4), 2);
}

}  // namespace

EmbeddedModel drawEmbeddedModel(const EmbeddedModelSize& size, Draw& draw) {
  EmbeddedModel model;
  const int zeros = draw.integer(0, size.order - 1);
  const auto plant = drawApart(size.order, 0.92, zeros, 1.4, draw);
  model.a = polynomialOf(plant.first);
  VectorXd b(zeros + 1);
  b << 1, polynomialOf(plant.second);
  model.b = b * (draw.logUniform(0.3, 3) * (1 + model.a.sum()));
  drawRest(size, draw, &model);
  return model;
}

EmbeddedModel drawDeadTimeModel(const EmbeddedModelSize& size, Draw& draw) {
  EmbeddedModel model;
  model.plant.gain = draw.logUniform(0.3, 3);
  model.plant.time_constants = {draw.logUniform(3, 10)};
  if (size.order == 2)
    model.plant.time_constants.push_back(model.plant.time_constants[0] * draw.uniform(0.3, 0.6));
  model.plant.dead_time = draw.uniform(0.2, 10);
  drawRest(size, draw, &model);
  return model;
}

std::vector<Experiment> measure(const EmbeddedModel& model, int experiments, Draw& draw) {
  constexpr int kRunUp = 500;
  std::vector<Experiment> all;
  for (int r = 0; r < experiments; ++r) {
    Experiment experiment;
    experiment.id = "experiment" + std::to_string(r);
    experiment.sample_time = 1;
    experiment.u = drawInput(model, draw);
    const VectorXd white = std::sqrt(model.noise_variance) * draw.normals(kRunUp + model.samples);
    experiment.y = noiseFreeOutput(model, perturbed(model, experiment.u, draw)) +
                   filtered(1, model.c, model.d, white).tail(model.samples);
    const int missing = draw.integer(5, 30);
    if (model.gaps && r % 3 == 0) {
      experiment.valid.assign(static_cast<std::size_t>(model.samples), 1);
      std::fill_n(experiment.valid.begin(), missing, std::uint8_t{0});
    }
    all.push_back(experiment);
  }
  return all;
}

VectorXd thetaOf(const EmbeddedModel& model) {
  VectorXd plant(model.b.size() + model.a.size());
  plant << model.b, model.a;
  if (!model.plant.time_constants.empty()) {
    std::vector<double> taus = model.plant.time_constants;
    std::sort(taus.begin(), taus.end());  // results list them so
    plant.resize(static_cast<Index>(taus.size()) + 2);
    plant[0] = model.plant.gain;
    for (std::size_t k = 0; k < taus.size(); ++k) plant[static_cast<Index>(k) + 1] = taus[k];
    plant[plant.size() - 1] = model.plant.dead_time;
  }
  VectorXd theta(plant.size() + model.c.size() + model.d.size());
  theta << plant, model.c, model.d;
  return theta;
}

void setOrders(const EmbeddedModel& model, Configuration* configuration) {
  NominalModelOptions& nominal = configuration->nominal_model;
  nominal = NominalModelOptions();
  nominal.orders_auto = false;
  nominal.nb = std::max(1, static_cast<int>(model.b.size()));  // at least 1 is allowed
  nominal.na = static_cast<int>(model.a.size());
  nominal.nc = static_cast<int>(model.c.size());
  nominal.nd = static_cast<int>(model.d.size());
  nominal.delay = 1;
  if (!model.plant.time_constants.empty()) {
    nominal.structure = Structure::continuous;
    nominal.time_constants = static_cast<int>(model.plant.time_constants.size());
    nominal.dead_time = true;
  }
  ErrorModelOptions& error_model = configuration->error_model;
  error_model = ErrorModelOptions();
  error_model.basis = BasisKind::fir;
  error_model.taps = model.taps;
  error_model.constraint = Constraint::zero_static_gain;
  error_model.components = std::max(1, model.mixture.components());
}

void startAtTruth(const EmbeddedModel& model, Configuration* configuration) {
  configuration->initial.theta = thetaOf(model);
  configuration->initial.mixture = model.mixture;
  configuration->initial.noise_variance = model.noise_variance;
}

}  // namespace uncertainty_identification::study
