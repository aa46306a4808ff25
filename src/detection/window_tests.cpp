#include "detection/window_tests.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "math/distributions.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kLags = 4;
constexpr double kManyDegrees = 1e6;  // above it F equals a chi-squared distribution
constexpr double kDependent = 1e-9;   // relative threshold for linear dependence
constexpr double kLeast = 1e-300;     // smallest probability whose logarithm is finite

double energyProbability(double energy, double count, double degrees) {
  if (!(degrees < kManyDegrees)) return chiSquaredTail(energy, count);
  return fisherTail(energy / count, count, degrees);
}

/// The probability that at least this share of the energy lies in `rank` of `count` dimensions.
double shareProbability(double share, double rank, double count) {
  const double bounded = std::min(std::max(share, 0.0), 1.0);
  return betaTail(bounded, rank / 2, (count - rank) / 2);
}

double correlationProbability(const VectorXd& z, double energy) {
  const auto count = static_cast<double>(z.size());
  double sum = 0;
  for (int lag = 1; lag <= kLags; ++lag) {
    const double r = z.tail(z.size() - lag).dot(z.head(z.size() - lag)) / energy;
    sum += count * (count + 2) * r * r / (count - lag);
  }
  return chiSquaredTail(sum, kLags);
}

}  // namespace

const char* nameOf(WindowTest test) {
  constexpr const char* kNames[kWindowTests] = {"energy", "mean", "input", "correlation"};
  return kNames[static_cast<int>(test)];
}

WindowProbabilities testWindow(const VectorXd& scores, const MatrixXd& effects,
                               double noise_degrees) {
  WindowProbabilities found;
  const auto count = static_cast<double>(scores.size());
  const double energy = scores.squaredNorm(), sum = scores.sum();
  found.tests[0] = energyProbability(energy, count, noise_degrees);
  int applicable = 1;
  if (energy > 0) {
    found.tests[1] = shareProbability(sum * sum / (count * energy), 1, count);
    found.tests[3] = correlationProbability(scores, energy);
    applicable += 2;
    Eigen::ColPivHouseholderQR<MatrixXd> qr(effects);
    qr.setThreshold(kDependent);
    if (effects.cwiseAbs().maxCoeff() > 0) {
      const VectorXd rotated = qr.householderQ().transpose() * scores;
      const Index rank = qr.rank();
      const double share = rotated.head(rank).squaredNorm() / energy;
      found.tests[2] = shareProbability(share, static_cast<double>(rank), count);
      ++applicable;
    }
  }
  Index strongest = 0;
  const double smallest = std::max(found.tests.minCoeff(&strongest), kLeast);
  found.strongest = static_cast<WindowTest>(strongest);
  found.combined = std::min(-std::expm1(applicable * std::log1p(-smallest)), 1.0);
  return found;
}

}  // namespace uncertainty_identification
