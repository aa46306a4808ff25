#include "model/sensitivity.h"

#include <gtest/gtest.h>

#include <complex>

#include "support/core_setup.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXcd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

constexpr double kSensitivityPeriod = 0.01;

NominalModelOptions circuit() {
  NominalModelOptions options;
  options.structure = Structure::continuous;
  options.resonances = 1;
  options.nc = 1;
  options.nd = 0;
  return options;
}

NominalModelOptions boxJenkins() {
  NominalModelOptions options;
  options.nb = options.na = 2;
  return options;
}

ErrorModelOptions sensitivity(int order, std::vector<std::string> parameters = {}) {
  ErrorModelOptions options;
  options.basis = BasisKind::sensitivity;
  options.constraint = Constraint::zero_mean;
  options.sensitivity_order = order;
  options.parameters = std::move(parameters);
  return options;
}

VectorXcd responseOf(const NominalModel& nominal, const VectorXd& theta, const VectorXd& omega) {
  const Polynomials p = nominal.polynomials(theta);
  VectorXcd response(omega.size());
  for (Eigen::Index k = 0; k < omega.size(); ++k) {
    std::complex<double> b = 0, a = 1;
    for (Eigen::Index i = 0; i < p.b.size(); ++i)
      b += p.b[i] * std::polar(1.0, -omega[k] * static_cast<double>(p.delay + i));
    for (Eigen::Index i = 0; i < p.a.size(); ++i)
      a += p.a[i] * std::polar(1.0, -omega[k] * static_cast<double>(i + 1));
    response[k] = b / a;
  }
  return response;
}

/// The expansion of G about theta leaves an error one order higher than its terms: halving the
/// deviation divides it by 4 with first derivatives, by 8 with the second ones.
void expectExpansion(const NominalModel& nominal, ErrorModelOptions options, const VectorXd& theta,
                     double expected_ratio) {
  completeErrorModel(nominal, &options);
  const SensitivityTerms terms = sensitivityTerms(nominal, options);
  ASSERT_EQ(terms.count(), options.taps);
  const VectorXd omega = test::vectorOf({0.01, 0.2, 1.0, 2.5});
  const MatrixXcd R = sensitivityResponses(nominal, terms, theta, omega);
  const auto remainder = [&](double size) {
    VectorXd moved = theta, xi(terms.count());
    const auto deviation = [&](int j) { return size * (j % 2 == 0 ? 1.0 : -0.6); };
    for (int i = 0; i < terms.count(); ++i) {
      xi[i] = 1;
      for (int j : terms.indices[static_cast<std::size_t>(i)]) xi[i] *= deviation(j);
      const auto& term = terms.indices[static_cast<std::size_t>(i)];
      if (term.size() == 1) moved[term[0]] *= 1 + deviation(term[0]);
    }
    return (responseOf(nominal, moved, omega) - responseOf(nominal, theta, omega) - R * xi).norm();
  };
  EXPECT_NEAR(remainder(2e-3) / remainder(1e-3), expected_ratio, 0.1 * expected_ratio);
}

TEST(Sensitivity, ExpandsAContinuousModelToItsOrder) {
  const auto nominal = makeNominalModel(circuit(), kSensitivityPeriod);
  const VectorXd theta = test::vectorOf({2.0, 0.02, 150.0, 0.3, 0.4});
  ASSERT_EQ(nominal->names()[1], "tau1");
  expectExpansion(*nominal, sensitivity(1), theta, 4);
  expectExpansion(*nominal, sensitivity(2, {"tau1", "omega1", "zeta1"}), theta, 8);
}

TEST(Sensitivity, ExpandsABoxJenkinsModelToItsOrder) {
  const auto nominal = makeNominalModel(boxJenkins(), kSensitivityPeriod);
  const VectorXd theta = test::vectorOf({1.0, 0.4, -1.2, 0.5, 0.1, 0.8});
  expectExpansion(*nominal, sensitivity(1), theta, 4);
  expectExpansion(*nominal, sensitivity(2, {"b2", "a1", "a2"}), theta, 8);
}

TEST(Sensitivity, ScaleIsTheProductHalvedForSquaresAndSoIsItsDerivative) {
  const auto nominal = makeNominalModel(boxJenkins(), kSensitivityPeriod);
  const SensitivityTerms terms = sensitivityTerms(*nominal, sensitivity(2, {"b1", "a1"}));
  // Go is linear in b1
  ASSERT_EQ(terms.indices, (std::vector<std::vector<int>>{{0}, {2}, {0, 2}, {2, 2}}));
  const VectorXd theta = test::vectorOf({3.0, 1.0, -0.5, 0.1, 0.0, 0.0});
  EXPECT_EQ(terms.scale(1, theta), -0.5);
  EXPECT_EQ(terms.scale(2, theta), -1.5);
  EXPECT_EQ(terms.scale(3, theta), 0.125);
  for (int i = 0; i < terms.count(); ++i) {
    const auto scale = [&](const VectorXd& at) {
      return VectorXd(VectorXd::Constant(1, terms.scale(i, at)));
    };
    const Eigen::MatrixXd expected = test::differences(scale, theta);
    for (int l = 0; l < theta.size(); ++l)
      EXPECT_NEAR(terms.scaleDerivative(i, l, theta), expected(0, l), 1e-9) << i << " " << l;
  }
}

TEST(Sensitivity, TakesAllParametersOfGoAndNoneOfH) {
  const auto nominal = makeNominalModel(boxJenkins(), kSensitivityPeriod);
  ErrorModelOptions options = sensitivity(1);
  completeErrorModel(*nominal, &options);
  EXPECT_EQ(options.parameters, (std::vector<std::string>{"b1", "b2", "a1", "a2"}));
  EXPECT_EQ(options.taps, 4);
}

TEST(Sensitivity, SpreadTakesTheOnlyParameterOrAsksForNames) {
  NominalModelOptions one = circuit();
  one.resonances = 0;
  one.fixed = {{"gain", 1.0}};
  ErrorModelOptions options = sensitivity(1);
  options.basis = BasisKind::parameter_spread;
  ErrorModelOptions taken = options;
  completeErrorModel(*makeNominalModel(one, kSensitivityPeriod), &taken);
  EXPECT_EQ(taken.parameters, (std::vector<std::string>{"tau1"}));
  const std::string message = messageOf<ConfigurationError>(
      [&] { completeErrorModel(*makeNominalModel(boxJenkins(), kSensitivityPeriod), &options); });
  EXPECT_NE(message.find("error_model.parameters"), std::string::npos) << message;
  EXPECT_NE(message.find("b1, b2, a1, a2"), std::string::npos) << message;
}

TEST(Sensitivity, RefusesNamesThatAreNotOfGoAndTooManyTerms) {
  const auto nominal = makeNominalModel(boxJenkins(), kSensitivityPeriod);
  for (const char* name : {"tau1", "c1"}) {
    ErrorModelOptions options = sensitivity(1, {name});
    const std::string message =
        messageOf<ConfigurationError>([&] { completeErrorModel(*nominal, &options); });
    EXPECT_NE(message.find(std::string("error_model.parameters: found ") + name), std::string::npos)
        << message;
  }
  ErrorModelOptions many = sensitivity(2);  // 4, and 10 less 3 of b
  const std::string message =
      messageOf<ConfigurationError>([&] { completeErrorModel(*nominal, &many); });
  EXPECT_NE(message.find("11 regressors"), std::string::npos) << message;
}

TEST(Sensitivity, LeavesOtherBasesAndNoErrorModelAlone) {
  const auto nominal = makeNominalModel(boxJenkins(), kSensitivityPeriod);
  ErrorModelOptions fir, none = sensitivity(1);
  none.taps = 0;
  completeErrorModel(*nominal, &fir);
  completeErrorModel(*nominal, &none);
  EXPECT_EQ(fir.taps, 2);
  EXPECT_TRUE(fir.parameters.empty());
  EXPECT_EQ(none.taps, 0);
}

}  // namespace
}  // namespace uncertainty_identification
