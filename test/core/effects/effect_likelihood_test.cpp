// The likelihood of extended models: its derivatives against differences, its values against dense
// covariance matrices, its information against the dense expectation.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>

#include "support/core_setup.h"
#include "support/dense_likelihood.h"
#include "support/effect_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TEST(EffectLikelihood, DerivativesAreThoseOfDifferences) {
  const test::EffectSetup setup;
  for (const auto& effect : setup.all()) {
    if (effect->stage() == Stage::data) continue;
    const auto model = setup.extendedBy({effect});
    const ModelParameters at = setup.at(test::noticeable(*effect));
    const Likelihood likelihood(*model, setup.blocks(), 11, 1);
    const Statistics statistics = likelihood.statistics(at.parameters, true);
    const MatrixXd found = scores(statistics, at, likelihood.expect(statistics, at));
    const auto value = [&](const VectorXd& parameters) {
      ModelParameters moved = at;
      moved.parameters = parameters;
      return setup.logLikelihoods(*model, moved);
    };
    // small steps: static nonlinearities have kinks
    const MatrixXd expected = test::differences(value, at.parameters, 1e-5);
    for (Index j = 0; j < at.parameters.size(); ++j) {
      const Index own = j - model->offsetOf(0);
      if (own >= 0 && !effect->description().parameters[static_cast<std::size_t>(own)].smooth)
        continue;
      EXPECT_LT((found.row(j).transpose() - expected.col(j)).norm(),
                1e-4 * (1 + expected.col(j).norm()))
          << effect->label() << ", " << model->names()[static_cast<std::size_t>(j)];
    }
  }
}

/// Linear model of setup.at() as dense matrices.
dense::Model denseModel(const test::EffectSetup& setup) {
  dense::Model model;
  model.b = test::vectorOf({0.9});
  model.a = test::vectorOf({-0.6});
  model.c = test::vectorOf({0.3});
  model.d = test::vectorOf({-0.4});
  model.basis = dense::firBasis(3, 3);
  model.basis_order = 2;
  model.T = setup.linear().basis().T();
  model.mixture = setup.at().mixture;
  model.noise_variance = setup.at().noise_variance;
  return model;
}

MatrixXd toeplitz(const VectorXd& numerator, const VectorXd& denominator, int samples) {
  return dense::toeplitz(dense::impulseResponse(numerator, denominator, 0, samples)).cast<double>();
}

double logDensity(const VectorXd& residual, const MatrixXd& covariance) {
  const Eigen::LLT<MatrixXd> factor(covariance);
  double log_determinant = 0;
  for (Index t = 0; t < residual.size(); ++t)
    log_determinant += 2 * std::log(factor.matrixLLT()(t, t));
  return -0.5 * (static_cast<double>(residual.size()) * std::log(2 * M_PI) + log_determinant +
                 factor.matrixL().solve(residual).squaredNorm());
}

/// Lemma 1 with other noise: V_i = sigma^2 noise(r) + Psi Gamma_i Psi', where y and x pass
/// `sensor`.
using NoiseOf = std::function<MatrixXd(const Experiment&, const MatrixXd& plain)>;
using SensorOf = std::function<MatrixXd(int samples)>;

VectorXd denseLikelihoods(const test::EffectSetup& setup, NoiseStart start, const NoiseOf& noise_of,
                          const SensorOf& sensor_of) {
  const dense::Model model = denseModel(setup);
  VectorXd all(11);
  for (std::size_t r = 0; r < 11; ++r) {
    const Experiment& experiment = setup.experiments()[r];
    const int samples = experiment.samples();
    const MatrixXd sensor = sensor_of(samples);
    const VectorXd a = dense::monic(model.a), b = test::vectorOf({0, 0.9});
    const VectorXd x = sensor * toeplitz(b, a, samples) * experiment.u;
    MatrixXd psi(samples, 2);
    for (int i = 0; i < 2; ++i)
      psi.col(i) = toeplitz(dense::product(b, model.T.col(i)), a, samples) * experiment.u;
    psi = sensor * psi;
    const MatrixXd noise =
        noise_of(experiment, dense::noiseCovariance(model, start, samples).cast<double>());
    std::vector<Index> rows;
    for (int t = 0; t < samples; ++t)
      if (experiment.isValid(t)) rows.push_back(t);
    double likelihood = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const MatrixXd covariance = model.noise_variance * sensor * noise * sensor.transpose() +
                                  psi * model.mixture.covariances[i] * psi.transpose();
      const VectorXd left = experiment.y - x - psi * model.mixture.means[i];
      MatrixXd seen(rows.size(), rows.size());
      VectorXd residual(rows.size());
      for (std::size_t k = 0; k < rows.size(); ++k) {
        residual[static_cast<Index>(k)] = left[rows[k]];
        for (std::size_t j = 0; j < rows.size(); ++j)
          seen(static_cast<Index>(k), static_cast<Index>(j)) = covariance(rows[k], rows[j]);
      }
      likelihood += model.mixture.weights[i] * std::exp(logDensity(residual, seen));
    }
    all[static_cast<Index>(r)] = std::log(likelihood);
  }
  return all;
}

MatrixXd unchanged(int samples) { return MatrixXd::Identity(samples, samples); }

void expectDense(const test::EffectSetup& setup, NoiseStart start, const std::string& name,
                 const std::string& variant, const NoiseOf& noise,
                 const SensorOf& sensor = unchanged) {
  const auto model = setup.extended({{name, variant}});
  const VectorXd psi = test::noticeable(*model->effects().front());
  const VectorXd found = setup.logLikelihoods(*model, setup.at(psi));
  const VectorXd expected = denseLikelihoods(setup, start, noise, sensor);
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-8) << name << "\n"
                                                            << found.transpose() << "\n"
                                                            << expected.transpose();
}

/// plain + variance z z'.
MatrixXd withRandom(MatrixXd plain, double log_variance, const VectorXd& z) {
  return plain + std::exp(log_variance) * z * z.transpose();
}

void expectRandomEffects(const test::EffectSetup& setup) {
  const auto start = NoiseStart::stationary;
  const auto time = [](const Experiment& of) {
    return VectorXd(VectorXd::LinSpaced(of.samples(), 0, of.samples() - 1));
  };
  expectDense(setup, start, "sens_bias", "per_experiment",
              [](const Experiment& of, const MatrixXd& plain) {
                return withRandom(plain, 1, VectorXd::Ones(of.samples()));
              });
  expectDense(setup, start, "sens_drift", "per_experiment",
              [&](const Experiment& of, const MatrixXd& plain) {
                return withRandom(plain, 1, time(of) / of.samples());
              });
  expectDense(
      setup, start, "sens_hum", "per_experiment", [&](const Experiment& of, const MatrixXd& plain) {
        const VectorXd angle = 1.5 * 0.5 * time(of);
        return withRandom(withRandom(plain, 1, angle.array().cos()), 1, angle.array().sin());
      });
  expectDense(setup, start, "plant_init", "", [&](const Experiment& of, const MatrixXd& plain) {
    VectorXd z = VectorXd::Ones(of.samples());
    for (Index t = 1; t < z.size(); ++t) z[t] = 0.6 * z[t - 1];
    return withRandom(plain, 2, z);
  });
  // dGo u/da1 times a1, Go = 0.9 q^-1/(1 + a1 q^-1)
  expectDense(
      setup, start, "plant_parameter_spread", "a1",
      [&](const Experiment& of, const MatrixXd& plain) {
        const VectorXd a = test::vectorOf({1, -0.6});
        const VectorXd z =
            0.6 * toeplitz(test::vectorOf({0, 0, 0.9}), dense::product(a, a), of.samples()) * of.u;
        return withRandom(plain, -2, z);
      });
}

TEST(EffectLikelihood, OfRandomEffectsIsTheDenseOne) { expectRandomEffects(test::EffectSetup()); }

std::vector<Experiment> withGaps() {
  std::vector<Experiment> experiments = test::recordedForEffects();
  for (std::size_t r = 0; r < experiments.size(); r += 2) {
    experiments[r].valid.assign(static_cast<std::size_t>(experiments[r].samples()), 1);
    for (std::size_t k : {7, 8, 20}) experiments[r].valid[k + r] = 0;
  }
  return experiments;
}

TEST(EffectLikelihood, OfRandomEffectsIsTheDenseOneWhereOutputsAreMissing) {
  expectRandomEffects(test::EffectSetup(test::effectConfiguration(), withGaps()));
}

Configuration noiseFromRest() {
  Configuration configuration = test::effectConfiguration();
  configuration.estimation.noise_start = NoiseStart::zero;
  return configuration;
}

/// H diag(s^2) H'.
NoiseOf scaled(const std::function<double(const Experiment&, int t)>& deviation) {
  return [deviation](const Experiment& of, const MatrixXd&) {
    const MatrixXd H = toeplitz(test::vectorOf({1, 0.3}), test::vectorOf({1, -0.4}), of.samples());
    VectorXd variances(of.samples());
    for (int t = 0; t < of.samples(); ++t) variances[t] = std::pow(deviation(of, t), 2);
    return MatrixXd(H * variances.asDiagonal() * H.transpose());
  };
}

TEST(EffectLikelihood, OfNoiseEffectsIsTheDenseOne) {
  const test::EffectSetup setup(noiseFromRest());
  const auto start = NoiseStart::zero;
  expectDense(setup, start, "noise_step", "", scaled([](const Experiment&, int t) {
                const double on = std::clamp(t - 9.3 / 0.5 + 1, 0.0, 1.0);
                return std::pow(1.6, on - 0.5);
              }));
  const double deviation = setup.summary().input_deviation;
  expectDense(setup, start, "noise_hetero", "u", scaled([&](const Experiment& of, int t) {
                return std::sqrt(0.6 + 0.4 * std::pow(of.u[t] / deviation, 2));
              }));
  expectDense(setup, start, "noise_colour", "", [](const Experiment& of, const MatrixXd&) {
    const MatrixXd H = toeplitz(
        test::vectorOf({1, 0.3}),
        dense::product(test::vectorOf({1, -0.4}), test::vectorOf({1, 0.3, -0.2})), of.samples());
    return MatrixXd(H * H.transpose());
  });
}

/// A lag of the sensor: x and the noise pass it.
TEST(EffectLikelihood, OfALagOfTheSensorIsTheDenseOne) {
  expectDense(
      test::EffectSetup(), NoiseStart::stationary, "sens_lag", "",
      [](const Experiment&, const MatrixXd& plain) { return plain; },
      [](int samples) {
        return toeplitz(test::vectorOf({0.6}), test::vectorOf({1, -0.4}), samples);
      });
}

/// The Fisher information of a random effect's variance, 1/2 tr (V^-1 dV)^2, where the error model
/// has no say.
TEST(EffectLikelihood, InformationOnVariancesIsTheDenseExpectation) {
  const test::EffectSetup setup;
  const auto model = setup.extended({{"sens_bias", "per_experiment"}});
  ModelParameters at = setup.at(test::vectorOf({-1}));
  for (std::size_t i = 0; i < 2; ++i) {
    at.mixture.means[i].setZero();
    at.mixture.covariances[i] *= 1e-12;
  }
  const Likelihood likelihood(*model, setup.blocks(), 11, 1);
  const Expectation expectation =
      likelihood.expect(likelihood.statistics(at.parameters, false), at);
  const MatrixXd observed = likelihood.information(at, latentMoments(expectation)).observed;
  double expected = 0;
  for (const Experiment& experiment : setup.experiments()) {
    const MatrixXd R =
        dense::noiseCovariance(denseModel(setup), NoiseStart::stationary, experiment.samples())
            .cast<double>();
    const MatrixXd change =
        std::exp(-1.0) * MatrixXd::Ones(experiment.samples(), experiment.samples());
    const MatrixXd inverse = (R + change).inverse();
    expected += 0.5 * (inverse * change * inverse * change).trace();
  }
  const int j = model->offsetOf(0);
  EXPECT_NEAR(observed(j, j), expected, 1e-5 * expected);
}

}  // namespace
}  // namespace uncertainty_identification
