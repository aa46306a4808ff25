#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// What a window of scores is tested for. Each test answers to faults of its own kind.
enum class WindowTest {
  energy,      ///< sum of squares: whatever the model cannot follow, more noise
  mean,        ///< a constant: sensor bias
  input,       ///< a share of the nominal output, now or a sample ago: lost gain, added delay
  correlation  ///< of successive scores: slow or oscillating effects, coloured noise
};
constexpr int kWindowTests = 4;

/// "energy", "mean", "input", "correlation".
const char* nameOf(WindowTest test);

/// How likely a window as extreme as this one is without a fault.
struct WindowProbabilities {
  /// Of each test, in the order of WindowTest; 1 where it does not apply (input: no excitation).
  Eigen::Vector4d tests = Eigen::Vector4d::Ones();
  WindowTest strongest = WindowTest::energy;  ///< the test with the smallest probability
  /// Of the window: 1 - (1 - smallest)^(number of tests that apply), uniform over (0, 1) without a
  /// fault where the tests are independent.
  double combined = 1;
};

/// Tests W scores that are independent N(0, 1) without a fault.
/// - energy: sum z^2 / W is F(W, noise_degrees), chi-squared for infinite noise_degrees: those of
///   the noise variance that the scores were scaled with (2 (value/standard error)^2).
/// - mean, input: the share of sum z^2 that lies along ones, or in the span of the effects, is
///   Beta(r/2, (W - r)/2) with r directions; exact for effects that do not depend on the scores.
/// - correlation: Ljung and Box's sum over the first four lags, about chi-squared(4).
/// All but the first depend on the direction of z alone and thus neither on its energy nor on the
/// noise variance. `effects`: W x k, of k effects of the input on the scores. W is at least 10.
WindowProbabilities testWindow(const Eigen::VectorXd& scores, const Eigen::MatrixXd& effects,
                               double noise_degrees);

}  // namespace uncertainty_identification
