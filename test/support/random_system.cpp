#include "support/random_system.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace uncertainty_identification::test {
namespace {

using Engine = std::mt19937_64;

Eigen::VectorXd normal(Eigen::Index size, Engine& engine) {
  std::normal_distribution<double> distribution;
  Eigen::VectorXd values(size);
  for (Eigen::Index k = 0; k < size; ++k) values[k] = distribution(engine);
  return values;
}

double uniformIn(double low, double high, Engine& engine) {
  return std::uniform_real_distribution<double>(low, high)(engine);
}

Eigen::VectorXd drawPolynomial(int order, double radius, Engine& engine) {
  Eigen::VectorXd polynomial = Eigen::VectorXd::Ones(1);
  while (polynomial.size() + 1 <= order) {
    const double r = uniformIn(0.2, 1.0, engine) * radius;
    const double angle = uniformIn(0.2, 2.9, engine);
    polynomial =
        dense::product(polynomial, Eigen::Vector3d(1.0, -2.0 * r * std::cos(angle), r * r));
  }
  if (polynomial.size() <= order) {
    polynomial =
        dense::product(polynomial, Eigen::Vector2d(1.0, uniformIn(-radius, radius, engine)));
  }
  return polynomial;
}

/// T = [I; -1'] (taps x (taps - 1)). FIR taps, and Laguerre filters, all have the same static gain.
Eigen::MatrixXd zeroStaticGain(int taps) {
  Eigen::MatrixXd t = Eigen::MatrixXd::Identity(taps, taps - 1);
  t.row(taps - 1).setConstant(-1.0);
  return t;
}

void drawErrorModel(const RandomSystemOptions& options, Engine& engine, dense::Model& truth) {
  const int taps = options.taps;
  truth.basis_order = std::max(taps - 1, 0);
  if (options.laguerre_pole == 0) {
    truth.basis = dense::firBasis(taps, taps);
  } else {
    truth.basis = dense::laguerreBasis(options.laguerre_pole, taps,
                                       options.input_run_up + options.max_samples);
    truth.basis_order = taps;
    const Eigen::VectorXd factor = Eigen::Vector2d(1.0, -options.laguerre_pole);
    Eigen::VectorXd denominator = Eigen::VectorXd::Ones(1);
    for (int k = 0; k < taps; ++k) denominator = dense::product(denominator, factor);
    truth.basis_denominator = denominator.tail(taps);
  }
  truth.T = options.zero_static_gain ? zeroStaticGain(taps)
                                     : Eigen::MatrixXd::Identity(taps, taps).eval();
  const Eigen::Index n = truth.T.cols();
  double total = 0;
  for (int i = 0; i < options.components; ++i) {
    truth.mixture.weights.push_back(uniformIn(0.5, 1.0, engine));
    total += truth.mixture.weights.back();
    truth.mixture.means.push_back(0.6 * normal(n, engine));
    Eigen::MatrixXd root(n, n);
    for (Eigen::Index k = 0; k < n; ++k) root.col(k) = 0.1 * normal(n, engine);
    truth.mixture.covariances.push_back(root * root.transpose() +
                                        0.02 * Eigen::MatrixXd::Identity(n, n));
  }
  for (auto& weight : truth.mixture.weights) weight /= total;
}

/// Direct-form recursion of q^-delay numerator/denominator from rest.
Eigen::VectorXd filter(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator,
                       int delay, const Eigen::VectorXd& input) {
  Eigen::VectorXd output = Eigen::VectorXd::Zero(input.size());
  for (Eigen::Index t = 0; t < input.size(); ++t) {
    for (Eigen::Index k = 0; k < numerator.size() && t - delay - k >= 0; ++k) {
      output[t] += numerator[k] * input[t - delay - k];
    }
    for (Eigen::Index k = 1; k < denominator.size() && t - k >= 0; ++k) {
      output[t] -= denominator[k] * output[t - k];
    }
  }
  return output;
}

/// (1 + GDelta(eta)) u.
Eigen::VectorXd perturbInput(const dense::Model& truth, const Eigen::VectorXd& xi,
                             const Eigen::VectorXd& u) {
  if (xi.size() == 0) return u;
  const Eigen::VectorXd response = truth.basis * (truth.T * xi);
  return u + filter(response, Eigen::VectorXd::Ones(1), 0, u);
}

void dropOutputs(double share, Engine& engine, Experiment& experiment) {
  if (share <= 0) return;
  experiment.valid.assign(static_cast<std::size_t>(experiment.samples()), 1);
  const int wanted = static_cast<int>(std::round(share * experiment.samples()));
  for (int dropped = 0; dropped < wanted;) {
    const int run = std::uniform_int_distribution<int>(1, 5)(engine);
    const int first = std::uniform_int_distribution<int>(0, experiment.samples() - 1)(engine);
    for (int k = first; k < std::min(first + run, experiment.samples()) && dropped < wanted; ++k) {
      auto& valid = experiment.valid[static_cast<std::size_t>(k)];
      dropped += valid;
      valid = 0;
      experiment.y[k] = std::numeric_limits<double>::quiet_NaN();
    }
  }
}

}  // namespace

Eigen::VectorXd randomPolynomial(int order, double radius, std::uint64_t seed) {
  Engine engine(seed);
  return drawPolynomial(order, radius, engine);
}

RandomSystem randomSystem(const RandomSystemOptions& options, std::uint64_t seed) {
  Engine engine(seed);
  dense::Model truth;
  truth.delay = options.delay;
  truth.a = drawPolynomial(options.na, options.pole_radius, engine).tail(options.na);
  truth.c = drawPolynomial(options.nc, options.pole_radius, engine).tail(options.nc);
  truth.d = drawPolynomial(options.nd, options.pole_radius, engine).tail(options.nd);
  truth.b = normal(options.nb, engine);
  truth.b[0] += truth.b[0] < 0 ? -0.5 : 0.5;
  truth.noise_variance = options.noise_variance;
  truth.T.resize(0, 0);
  if (options.taps > 0) drawErrorModel(options, engine, truth);
  return simulateSystem(truth, options, engine());
}

RandomSystem simulateSystem(const dense::Model& truth, const RandomSystemOptions& options,
                            std::uint64_t seed) {
  Engine engine(seed);
  const auto& mixture = truth.mixture;
  RandomSystem system;
  system.truth = truth;
  for (int r = 0; r < options.experiments; ++r) {
    const int samples =
        std::uniform_int_distribution<int>(options.min_samples, options.max_samples)(engine);
    int component = 0;
    Eigen::VectorXd xi(0);
    if (mixture.components() > 0) {
      component =
          std::discrete_distribution<int>(mixture.weights.begin(), mixture.weights.end())(engine);
      const auto i = static_cast<std::size_t>(component);
      xi = mixture.means[i] +
           mixture.covariances[i].llt().matrixL() * normal(mixture.dimension(), engine);
    }
    const Eigen::VectorXd u =
        options.input_deviation * normal(options.input_run_up + samples, engine);
    const Eigen::VectorXd omega =
        std::sqrt(truth.noise_variance) * normal(options.noise_run_up + samples, engine);
    const Eigen::VectorXd x =
        filter(truth.b, dense::monic(truth.a), truth.delay, perturbInput(truth, xi, u));
    const Eigen::VectorXd noise = filter(dense::monic(truth.c), dense::monic(truth.d), 0, omega);
    Experiment experiment;
    experiment.id = "random" + std::to_string(r);
    experiment.sample_time = 1.0;
    experiment.u = u.tail(samples);
    experiment.y = (x.tail(samples) + noise.tail(samples)).array() + options.output_offset;
    dropOutputs(options.missing, engine, experiment);
    system.experiments.push_back(experiment);
    system.errors.push_back(xi);
    system.components.push_back(component);
  }
  return system;
}

}  // namespace uncertainty_identification::test
