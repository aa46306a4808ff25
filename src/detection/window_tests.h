#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// The tests of a window of scores. Each is sensitive to another kind of fault.
enum class WindowTest {
  energy,      ///< sum of squares: more noise, or anything that the model does not predict
  mean,        ///< a constant, such as a sensor bias
  input,       ///< a multiple of the nominal output or its predecessor: changed gain or delay
  correlation  ///< between successive scores: slow or oscillating effects, coloured noise
};
constexpr int kWindowTests = 4;

/// "energy", "mean", "input", "correlation".
const char* nameOf(WindowTest test);

/// The probability that a window without a fault is at least as extreme as this one.
struct WindowProbabilities {
  /// For each test, in the order of WindowTest; 1 if it does not apply (input: no excitation).
  Eigen::Vector4d tests = Eigen::Vector4d::Ones();
  WindowTest strongest = WindowTest::energy;  ///< the test with the smallest probability
  /// For the whole window: 1 - (1 - smallest)^(number of tests that apply). Without a fault it is
  /// uniform over (0, 1) if the tests are independent.
  double combined = 1;
};

/// Tests W scores that are independent N(0, 1) without a fault.
/// - energy: sum z^2 / W has the distribution F(W, noise_degrees), which is chi-squared for
/// infinite
///   noise_degrees. These are the degrees of freedom of the estimated noise variance that the
///   scores were scaled with: 2 (value/standard error)^2.
/// - mean, input: the share of sum z^2 in the direction of a constant, or in the r-dimensional span
/// of
///   the effects, has the distribution Beta(r/2, (W - r)/2). This is exact for effects that do not
///   depend on the scores.
/// - correlation: the statistic of Ljung and Box over the first four lags is about chi-squared(4).
/// All tests but the first depend only on the direction of z, so not on the noise variance.
/// `effects` (W x k) are k effects of the input on the scores. W is at least 10.
WindowProbabilities testWindow(const Eigen::VectorXd& scores, const Eigen::MatrixXd& effects,
                               double noise_degrees);

}  // namespace uncertainty_identification
