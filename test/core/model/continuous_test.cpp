#include "model/continuous.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "support/core_setup.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::vectorOf;

constexpr double kSampleTime = 0.02;

NominalModelOptions options(int time_constants, int resonances, int zeros, bool dead_time) {
  NominalModelOptions made;
  made.structure = Structure::continuous;
  made.time_constants = time_constants;
  made.resonances = resonances;
  made.zeros = zeros;
  made.dead_time = dead_time;
  made.max_delay = 6;
  made.nc = made.nd = 0;
  return made;
}

/// Response of the polynomials to a unit step of the input at sample 0.
VectorXd stepResponse(const Polynomials& p, int samples) {
  const dense::Vector h = dense::impulseResponse(p.b, dense::monic(p.a), p.delay, samples);
  VectorXd response(samples);
  dense::Real sum = 0;
  for (Eigen::Index t = 0; t < samples; ++t) response[t] = static_cast<double>(sum += h[t]);
  return response;
}

/// The hold does not change a step, so the samples must be those of the continuous step response.
void expectStepResponse(const NominalModel& model, const VectorXd& theta, double late,
                        const std::function<double(double)>& continuous) {
  const VectorXd found = stepResponse(model.polynomials(theta), 60);
  for (Eigen::Index t = 0; t < found.size(); ++t) {
    const double time = static_cast<double>(t) * kSampleTime - late;
    EXPECT_NEAR(found[t], time <= 0 ? 0 : continuous(time), 1e-10) << "sample " << t;
  }
}

TEST(Continuous, FirstOrderInClosedForm) {
  const auto model = makeContinuous(options(1, 0, 0, false), kSampleTime);
  const Polynomials p = model->polynomials(vectorOf({3.0, 0.05}));
  const double pole = std::exp(-kSampleTime / 0.05);
  EXPECT_EQ(p.delay, 1);
  EXPECT_NEAR(p.a[0], -pole, 1e-14);
  EXPECT_NEAR(p.b[0], 3 * (1 - pole), 1e-14);
}

TEST(Continuous, ResonanceInClosedForm) {
  const auto model = makeContinuous(options(0, 1, 0, false), kSampleTime);
  const double omega = 40, zeta = 0.2;
  const Polynomials p = model->polynomials(vectorOf({1.0, omega, zeta}));
  const double damped = omega * std::sqrt(1 - zeta * zeta), angle = damped * kSampleTime;
  const double decay = std::exp(-zeta * omega * kSampleTime);
  const double mixed = zeta * omega / damped * std::sin(angle);
  EXPECT_NEAR(p.a[0], -2 * decay * std::cos(angle), 1e-13);
  EXPECT_NEAR(p.a[1], decay * decay, 1e-13);
  EXPECT_NEAR(p.b[0], 1 - decay * (std::cos(angle) + mixed), 1e-13);
  EXPECT_NEAR(p.b[1], decay * decay + decay * (mixed - std::cos(angle)), 1e-13);
}

TEST(Continuous, TwoTimeConstantsAndAZeroHaveTheContinuousStepResponse) {
  const auto model = makeContinuous(options(2, 0, 1, false), kSampleTime);
  EXPECT_EQ(model->names(), (std::vector<std::string>{"gain", "tau1", "tau2", "zero1"}));
  const double gain = -2, slow = 0.2, fast = 0.03, zero = -0.05;
  const double of_slow = (slow - zero) / (slow - fast), of_fast = (fast - zero) / (fast - slow);
  expectStepResponse(*model, vectorOf({gain, slow, fast, zero}), 0, [&](double t) {
    return gain * (of_slow * (1 - std::exp(-t / slow)) + of_fast * (1 - std::exp(-t / fast)));
  });
}

TEST(Continuous, EqualTimeConstants) {
  const auto model = makeContinuous(options(2, 0, 0, false), kSampleTime);
  expectStepResponse(*model, vectorOf({1.0, 0.07, 0.07}), 0,
                     [](double t) { return 1 - std::exp(-t / 0.07) * (1 + t / 0.07); });
}

TEST(Continuous, DeadTimeShiftsTheStepResponseByAnyFraction) {
  const auto model = makeContinuous(options(1, 0, 0, true), kSampleTime);
  for (double samples : {0.0, 0.25, 0.999, 1.0, 1.5, 3.7, 5.999}) {
    const double dead_time = samples * kSampleTime;
    expectStepResponse(*model, vectorOf({1.5, 0.06, dead_time}), dead_time,
                       [](double t) { return 1.5 * (1 - std::exp(-t / 0.06)); });
  }
}

TEST(Continuous, FractionalDeadTimeInClosedForm) {
  const auto model = makeContinuous(options(1, 0, 0, true), kSampleTime);
  const double fraction = 0.3, tau = 0.05;
  const Polynomials p = model->polynomials(vectorOf({1.0, tau, (2 + fraction) * kSampleTime}));
  const double late = std::exp(-(1 - fraction) * kSampleTime / tau);
  ASSERT_EQ(p.b.size(), 8);  // order 1 and up to 6 samples of dead time, and the fraction's own
  EXPECT_NEAR(p.b[2], 1 - late, 1e-14);
  EXPECT_NEAR(p.b[3], late - std::exp(-kSampleTime / tau), 1e-14);
  EXPECT_NEAR(p.b.cwiseAbs().sum(), p.b[2] + p.b[3], 1e-14);
}

TEST(Continuous, IsContinuousAcrossWholeSamplesOfDeadTime) {
  const auto model = makeContinuous(options(1, 1, 1, true), kSampleTime);
  const double tiny = 1e-10;
  for (int samples = 1; samples <= 6; ++samples) {
    const double dead_time = samples * kSampleTime;
    const auto at = [&](double late) {
      return model->polynomials(vectorOf({1.0, 0.05, 30, 0.4, 0.01, late})).stacked();
    };
    EXPECT_LT((at(dead_time - tiny) - at(dead_time)).norm(), 1e-7) << samples;
    if (samples == 6) continue;
    EXPECT_LT((at(dead_time + tiny) - at(dead_time)).norm(), 1e-7) << samples;
  }
}

TEST(Continuous, DelayComesOnTop) {
  NominalModelOptions late = options(1, 0, 0, true);
  late.delay = 3;
  const auto model = makeContinuous(late, kSampleTime);
  expectStepResponse(*model, vectorOf({1.0, 0.06, 0.4 * kSampleTime}), 2.4 * kSampleTime,
                     [](double t) { return 1 - std::exp(-t / 0.06); });
}

TEST(Continuous, FixedParametersAreNoParameters) {
  NominalModelOptions circuit = options(1, 0, 0, false);
  circuit.fixed = {{"gain", 1.0}};
  circuit.nc = 1;
  circuit.nd = 2;
  const auto model = makeContinuous(circuit, kSampleTime);
  EXPECT_EQ(model->names(), (std::vector<std::string>{"tau1", "c1", "d1", "d2"}));
  EXPECT_EQ(model->units().front(), "s");
  EXPECT_EQ(model->units().size(), 4u);
  const Polynomials p = model->polynomials(vectorOf({0.05, 0.1, 0.2, 0.3}));
  EXPECT_NEAR(p.b[0], 1 - std::exp(-kSampleTime / 0.05), 1e-14);
  EXPECT_EQ(p.c, vectorOf({0.1}));
  EXPECT_EQ(p.d, vectorOf({0.2, 0.3}));
}

TEST(Continuous, RefusesWhatIsNotStrictlyProperOrUnknown) {
  EXPECT_THROW(makeContinuous(options(1, 0, 1, false), 1), ConfigurationError);
  EXPECT_THROW(makeContinuous(options(0, 0, 0, false), 1), ConfigurationError);
  NominalModelOptions made = options(1, 0, 0, false);
  made.delay = 0;
  EXPECT_THROW(makeContinuous(made, 1), ConfigurationError);
  made.delay = 1;
  made.fixed = {{"tua1", 1.0}};
  const std::string message = messageOf<ConfigurationError>([&] { makeContinuous(made, 1); });
  EXPECT_NE(message.find("tua1"), std::string::npos) << message;
  EXPECT_NE(message.find("tau1"), std::string::npos) << message;
}

TEST(Continuous, UnboundedCoordinatesRoundTripAndStayAdmissible) {
  NominalModelOptions all = options(1, 1, 1, true);
  all.nc = 1;
  all.nd = 2;
  const auto model = makeContinuous(all, kSampleTime);
  const VectorXd theta = vectorOf({-1.5, 0.05, 30, 0.4, 0.01, 0.033, 0.3, -0.5, 0.2});
  ASSERT_EQ(theta.size(), model->parameterCount());
  EXPECT_TRUE(model->admissible(theta));
  EXPECT_LT((model->fromUnbounded(model->toUnbounded(theta)) - theta).norm(), 1e-12);
  for (double scale : {-3.0, -0.5, 0.7, 4.0}) {
    EXPECT_TRUE(model->admissible(model->fromUnbounded(VectorXd::Constant(9, scale)))) << scale;
  }
  const auto back = [&](const VectorXd& z) { return model->fromUnbounded(z); };
  const VectorXd z = model->toUnbounded(theta);
  EXPECT_LT((model->unboundedJacobian(z) - test::differences(back, z)).norm(), 1e-7);
}

TEST(Continuous, JacobianMatchesDifferences) {
  const auto expectDifferences = [](const NominalModelOptions& of, const VectorXd& theta) {
    const auto model = makeContinuous(of, kSampleTime);
    const auto polynomials = [&](const VectorXd& at) { return model->polynomials(at).stacked(); };
    const Eigen::MatrixXd expected = test::differences(polynomials, theta);
    for (Eigen::Index j = 0; j < theta.size(); ++j) {
      EXPECT_LT((model->jacobian(theta).col(j) - expected.col(j)).norm(),
                1e-7 * expected.col(j).norm())
          << of.time_constants << " time constants, "
          << model->names()[static_cast<std::size_t>(j)];
    }
  };
  expectDifferences(options(1, 0, 0, false), vectorOf({2, 0.05}));
  expectDifferences(options(2, 0, 0, true), vectorOf({2, 0.05, 0.2, 0.033}));
  expectDifferences(options(0, 1, 1, false), vectorOf({2, 30, 0.4, 0.01}));
  expectDifferences(options(1, 1, 1, true), vectorOf({-1.5, 0.05, 30, 0.4, 0.01, 0.033}));
  expectDifferences(options(3, 1, 1, true), vectorOf({-1.5, 0.05, 0.1, 0.3, 30, 0.4, 0.01, 0.033}));
}

TEST(Continuous, JacobianHasItsRowsWhereAllOfThePlantIsFixed) {
  NominalModelOptions known = options(1, 0, 0, false);
  known.fixed = {{"gain", 2}, {"tau1", 0.1}};
  known.nd = 1;
  const auto model = makeContinuous(known, kSampleTime);
  const Eigen::MatrixXd jacobian = model->jacobian(vectorOf({0.3}));
  ASSERT_EQ(jacobian.rows(), model->polynomials(vectorOf({0.3})).stacked().size());
  EXPECT_EQ(jacobian, (Eigen::MatrixXd(3, 1) << 0, 0, 1).finished());
}

TEST(Continuous, RefusesInadmissibleParameters) {
  const auto model = makeContinuous(options(1, 0, 0, true), kSampleTime);
  EXPECT_TRUE(model->admissible(vectorOf({1, 0.05, 0})));
  EXPECT_FALSE(model->admissible(vectorOf({1, -0.05, 0})));
  EXPECT_FALSE(model->admissible(vectorOf({1, 0.05, -0.001})));
  EXPECT_FALSE(model->admissible(vectorOf({1, 0.05, 7 * kSampleTime})));
  EXPECT_FALSE(model->admissible(vectorOf({std::nan(""), 0.05, 0})));
}

TEST(Continuous, FindsPhysicalParametersOfPolynomials) {
  const auto model = makeContinuous(options(1, 1, 0, false), kSampleTime);
  const VectorXd theta = vectorOf({2.0, 0.05, 30, 0.4});
  const VectorXd found = model->fromPolynomials(model->polynomials(theta));
  EXPECT_LT((found - theta).cwiseQuotient(theta).norm(), 1e-8) << found.transpose();
}

TEST(Continuous, FindsTheDeadTimeOfPolynomials) {
  const auto model = makeContinuous(options(1, 1, 0, true), kSampleTime);
  for (const double samples : {0.3, 1.7, 3.4}) {
    const VectorXd theta = vectorOf({2.0, 0.05, 30, 0.4, samples * kSampleTime});
    const VectorXd found = model->fromPolynomials(model->polynomials(theta));
    EXPECT_NEAR(found[4], theta[4], 1e-3 * kSampleTime) << samples;
  }
}

}  // namespace
}  // namespace uncertainty_identification
