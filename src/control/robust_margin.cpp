#include "uncertainty_identification/control/robust_margin.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <sstream>
#include <vector>

#include "configuration/require.h"
#include "math/constants.h"
#include "math/distributions.h"
#include "math/polynomial.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kOnCircle = 1e-6;  // tolerance of a pole's distance from the unit circle
constexpr int kGridPoints = 4096;   // not counting those added at resonances
constexpr double kConfidence = 0.95;

VectorXd sum(const VectorXd& left, const VectorXd& right) {
  VectorXd all = VectorXd::Zero(std::max(left.size(), right.size()));
  all.head(left.size()) += left;
  all.head(right.size()) += right;
  return all;
}

/// q^-delay B.
VectorXd delayed(int delay, const VectorXd& b) {
  VectorXd all = VectorXd::Zero(delay + b.size());
  all.tail(b.size()) = b;
  return all;
}

/// The polynomial divided by its leading coefficient, without the leading 1.
VectorXd normalised(const VectorXd& polynomial) {
  return polynomial.tail(polynomial.size() - 1) / polynomial[0];
}

/// Characteristic polynomial A Den + B Num of the loop. If its leading coefficient is nearly 0, the
/// loop is algebraic and has no solution.
VectorXd characteristic(const VectorXd& a, const VectorXd& b, const RationalFunction& controller) {
  const VectorXd left = product(a, controller.den), right = product(b, controller.num);
  VectorXd all = sum(left, right);
  const double scale = std::abs(left[0]) + std::abs(right[0]);
  if (!(std::abs(all[0]) > 1e-9 * scale)) {
    throw ConfigurationError(
        "controller: with a plant without delay, 1 + b1 num_0/den_0 = 0 is an algebraic loop "
        "without a solution; delay the controller by a sample");
  }
  return all;
}

/// |W T| as a function of the angle omega Ts, with T = q^-delay B Num/characteristic.
struct Loop {
  VectorXd numerator, denominator;

  double at(double angle) const {
    const std::complex<double> z_inverse = std::polar(1.0, -angle);
    return std::abs(valueAt(numerator, z_inverse)) / std::abs(valueAt(denominator, z_inverse));
  }
};

/// Angles in [0, pi], ascending: spaced evenly in angle and in its logarithm, and in addition
/// around every pole, the more closely the nearer the pole is to the unit circle.
std::vector<double> angles(const VectorXd& denominator) {
  std::vector<double> all{0, kPi};
  for (int k = 1; k < kGridPoints; ++k) {
    const double share = static_cast<double>(k) / kGridPoints;
    all.push_back(kPi * share);
    all.push_back(kPi * std::pow(1e-6, 1 - share));
  }
  for (const std::complex<double>& pole : listOfRoots(normalised(denominator))) {
    const double centre = std::abs(std::arg(pole)), width = std::abs(1 - std::abs(pole));
    for (int k = -40; k <= 40; ++k) {
      const double angle = centre + width * std::sinh(0.1 * k);
      if (angle > 0 && angle < kPi) all.push_back(angle);
    }
    all.push_back(std::min(centre, kPi));
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The maximum between two angles, by golden-section search.
double refined(const Loop& loop, double low, double high) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = loop.at(a), at_b = loop.at(b);
  for (int step = 0; step < 60; ++step) {
    if (at_a > at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = high - golden * (high - low);
      at_a = loop.at(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = low + golden * (high - low);
      at_b = loop.at(b);
    }
  }
  return 0.5 * (low + high);
}

void findPeak(const Loop& loop, double sample_time, RobustMargin* margin) {
  const std::vector<double> grid = angles(loop.denominator);
  std::vector<double> values;
  values.reserve(grid.size());
  for (double angle : grid) values.push_back(loop.at(angle));
  const double highest = *std::max_element(values.begin(), values.end());
  double best = 0;
  const auto consider = [&](double angle) {
    const double value = loop.at(angle);
    if (value < margin->peak) return;
    margin->peak = value;
    best = angle;
  };
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (values[k] < 0.9 * highest) continue;
    consider(grid[k]);
    const std::size_t before = k > 0 ? k - 1 : k, after = k + 1 < grid.size() ? k + 1 : k;
    if (values[k] >= values[before] && values[k] >= values[after])
      consider(refined(loop, grid[before], grid[after]));
  }
  margin->peak_omega = best / sample_time;
  margin->margin = margin->peak > 0 ? 1 / margin->peak : std::numeric_limits<double>::infinity();
}

void sampleStability(const PlantDistribution& plants, const RobustMarginOptions& options,
                     RobustMargin* margin) {
  const int samples = options.samples;
  margin->uncertainty = plants.hasEstimationErrors() ? Uncertainty::total : Uncertainty::mixture;
  margin->samples = samples;
  const MatrixXd all = characteristicPolynomials(
      plants.draw(samples, margin->uncertainty, options.seed), options.controller);
  int unstable = 0;
  for (Index i = 0; i < all.rows(); ++i) unstable += isStable(all.row(i).transpose()) ? 0 : 1;
  const double count = samples, share = unstable / count;
  margin->unstable_probability = share;
  margin->unstable_error = std::sqrt(share * (1 - share) / count);
  margin->unstable_upper =
      unstable == samples ? 1 : betaQuantile(kConfidence, unstable + 1.0, count - unstable);
}

}  // namespace

void requireController(const RationalFunction& controller, const std::string& key) {
  const auto refuse = [&key](const std::string& what) { throw ConfigurationError(key + what); };
  const VectorXd &num = controller.num, &den = controller.den;
  if (num.size() == 0 || !num.allFinite() || num.cwiseAbs().maxCoeff() == 0)
    refuse(".num: needs finite coefficients that are not all zero");
  if (den.size() == 0 || !den.allFinite() || den[0] == 0) {
    refuse(
        ".den: needs finite coefficients, the first not zero (powers of q^-1: den_0 + den_1 "
        "q^-1 + ...)");
  }
  if (den.size() == 1) return;
  const double largest = roots(normalised(den)).cwiseAbs().maxCoeff();
  if (largest <= 1 + kOnCircle) return;
  std::ostringstream message;
  message << ".den: found a pole of magnitude " << largest
          << "; allowed: up to 1 (integrators). The coefficients go with powers of q^-1: 1 - 0.9 "
             "q^-1 is [1, -0.9]";
  refuse(message.str());
}

void RobustMarginOptions::validate() const {
  requireController(controller);
  requireRange("minimum_margin", minimum_margin, 1.0, 1000.0);
  requireRange("samples", samples, 100, 1000000);
}

MatrixXd characteristicPolynomials(const PlantSamples& plants, const RationalFunction& controller) {
  const TransferFunctions models = transferFunctions(plants);
  MatrixXd all;
  for (Index i = 0; i < models.num.rows(); ++i) {
    const VectorXd b = delayed(plants.delay, models.num.row(i).transpose());
    const VectorXd one = normalised(characteristic(models.den.row(i).transpose(), b, controller));
    if (all.rows() == 0) all.resize(models.num.rows(), one.size());
    all.row(i) = one.transpose();
  }
  return all;
}

RobustMargin robustMargin(const PlantDistribution& plants, const RationalFunction& weight,
                          const RobustMarginOptions& options) {
  options.validate();
  const RationalFunction& controller = options.controller;
  if (weight.num.size() == 0 || weight.den.size() == 0 || !weight.num.allFinite() ||
      !weight.den.allFinite() || weight.den[0] == 0 || !isStable(normalised(weight.den))) {
    throw DataError("the weight W(z) is not a stable rational function");
  }
  const PlantSamples& go = plants.nominal();
  const VectorXd a = withLeadingOne(go.a.row(0).transpose());
  const VectorXd b = delayed(go.delay, go.b.row(0).transpose());
  const VectorXd closed = characteristic(a, b, controller);
  RobustMargin margin;
  margin.nominal_stable = isStable(normalised(closed));
  if (margin.nominal_stable) {
    const Loop loop{product(product(weight.num, b), controller.num), product(weight.den, closed)};
    findPeak(loop, go.sample_time, &margin);
  }
  sampleStability(plants, options, &margin);
  return margin;
}

}  // namespace uncertainty_identification
