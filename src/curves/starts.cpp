#include "curves/starts.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>

#include "curves/free_simulation.h"
#include "curves/initial_states.h"
#include "curves/window_fit.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

/// Poles near or outside the unit circle moved to 0.99.
Eigen::VectorXd pulledIn(const Eigen::VectorXd& a) {
  if (isStable(a, 0.998)) return a;
  Eigen::VectorXcd poles = roots(a);
  poles = (poles.array() / (poles.array().abs() / 0.99).max(1.0)).matrix();
  Eigen::VectorXcd polynomial = Eigen::VectorXcd::Zero(poles.size() + 1);
  polynomial[0] = 1;
  for (Eigen::Index k = 0; k < poles.size(); ++k)
    for (Eigen::Index i = k + 1; i > 0; --i) polynomial[i] -= poles[k] * polynomial[i - 1];
  return polynomial.tail(a.size()).real();
}

struct FilteredRegression {
  Eigen::MatrixXd regressors;
  Eigen::VectorXd output;
};

/// y = -a y(k-i) + b u(k-i-delay) [+ b_0 u(k-delay)] [+ c v(k-i)] + constant, all filtered by 1/A;
/// v is the covariate, if one is named.
FilteredRegression filteredRegression(const SimulationData& data, int order, bool direct, int delay,
                                      const Eigen::VectorXd& a, int first,
                                      const std::string& covariate) {
  const int of_input = 2 * order + (direct ? 1 : 0);
  const int columns = of_input + (covariate.empty() ? 0 : order) + 1;
  FilteredRegression made{Eigen::MatrixXd(data.samples, columns), Eigen::VectorXd(data.samples)};
  Eigen::Index row = 0;
  for (const SimulationWindow& window : data.windows) {
    const Eigen::VectorXd y = dividedBy(a, window.y), u = dividedBy(a, window.u),
                          one = dividedBy(a, Eigen::VectorXd::Ones(window.samples()));
    Eigen::VectorXd v;
    if (!covariate.empty()) v = dividedBy(a, window.covariates.at(covariate));
    for (int k = std::max(first, order); k < window.samples(); ++k) {
      if (window.measured[k] == 0 || row == made.output.size()) continue;
      for (int i = 0; i < order; ++i) {
        made.regressors(row, i) = -y[k - 1 - i];
        made.regressors(row, order + i) = u[std::max(k - 1 - i - delay, 0)];
        if (v.size() > 0) made.regressors(row, of_input + i) = v[k - 1 - i];
      }
      if (direct) made.regressors(row, 2 * order) = u[std::max(k - delay, 0)];
      made.regressors(row, columns - 1) = one[k];
      made.output[row++] = y[k];
    }
  }
  made.regressors.conservativeResize(row, columns);
  made.output.conservativeResize(row);
  return made;
}

/// Its least squares; empty where the rows are too few, or the solution is not finite.
Eigen::VectorXd solutionOf(const FilteredRegression& regression) {
  if (regression.output.size() <= regression.regressors.cols()) return {};
  Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> decomposition;
  decomposition.setThreshold(1e-9);
  Eigen::VectorXd theta = decomposition.compute(regression.regressors).solve(regression.output);
  return theta.allFinite() ? theta : Eigen::VectorXd();
}

/// The first sample of a window that the regression uses, once the filter has settled.
int firstSample(const SimulationData& data, int order, int iteration) {
  return iteration == 0 ? order : std::min(3 * order + 2, data.longest / 4);
}

/// A constant at the output as a bias of the plant's input.
double biasOf(const Eigen::VectorXd& theta, int order, bool direct) {
  const double gain = theta.segment(order, order + (direct ? 1 : 0)).sum();
  if (std::abs(gain) < 1e-6) return 0;
  return std::min(std::max(theta[theta.size() - 1] / gain, -20.0), 20.0);
}

}  // namespace

CurveModel linearStart(const SimulationData& data, int order, bool direct, int delay,
                       int iterations) {
  CurveModel best;
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd a = Eigen::VectorXd::Zero(order);
  for (int k = 0; k < iterations; ++k) {
    CurveModel model;
    model.order = order;
    model.direct = direct;
    model.delay = delay;
    model.own_level = data.own_levels;
    model.theta = solutionOf(
        filteredRegression(data, order, direct, delay, a, firstSample(data, order, k), ""));
    if (model.theta.size() == 0) break;
    a = pulledIn(model.theta.head(order));
    model.theta.head(order) = a;
    model.theta[model.biasIndex()] = biasOf(model.theta, order, direct);
    model.initial = initialStates(data, model, data.longest, 3);
    const double error = simulationError(data, model);
    if (error < least || best.theta.size() == 0) {
      least = error;
      best = std::move(model);
    }
  }
  return best;
}

double ratioOfGains(const SimulationData& data, const CurveModel& linear,
                    const std::string& covariate) {
  constexpr int kIterations = 4;
  constexpr double kMost = 30;
  const int n = linear.order, of_input = n + (linear.direct ? 1 : 0);  // coefficients
  Eigen::VectorXd a = Eigen::VectorXd::Zero(n);
  double ratio = 0;
  for (int k = 0; k < kIterations; ++k) {
    const Eigen::VectorXd theta = solutionOf(filteredRegression(
        data, n, linear.direct, linear.delay, a, firstSample(data, n, k), covariate));
    if (theta.size() == 0) break;
    a = pulledIn(theta.head(n));
    const double gain = theta.segment(n, of_input).sum(),
                 of_covariate = theta.segment(n + of_input, n).sum();
    if (std::abs(of_covariate) > kMost * std::abs(gain))
      ratio = (gain < 0) == (of_covariate < 0) ? kMost : -kMost;
    else
      ratio = of_covariate == 0 ? 0 : of_covariate / gain;
  }
  return ratio;
}

CurveModel withMode(const SimulationData& data, const CurveModel& model) {
  SimulationData left = data;
  const std::vector<CurveTable> tables = tablesOf(model);
  for (std::size_t w = 0; w < left.windows.size(); ++w)
    left.windows[w].y -= simulateFreely(model, tables, data.windows[w], model.initial[w], false).y;
  const CurveModel mode = linearStart(left, 2, false, model.delay);
  if (mode.order == 0) return withCancellingPair(withCancellingPair(model, 0.5), 0.5);
  const auto denominator = [](const CurveModel& of) {
    return withLeadingOne(of.theta.head(of.order));
  };
  const auto numerator = [](const CurveModel& of) {
    Eigen::VectorXd b = Eigen::VectorXd::Zero(of.order + 1);
    b.tail(of.order) = of.theta.segment(of.order, of.order);
    return b;
  };
  CurveModel sum;
  sum.order = model.order + 2;
  sum.delay = model.delay;
  sum.own_level = model.own_level;
  sum.theta.setZero(sum.linearParameters());
  sum.theta.head(sum.order) = product(denominator(model), denominator(mode)).tail(sum.order);
  sum.theta.segment(sum.order, sum.order) =
      (product(numerator(model), denominator(mode)) + product(numerator(mode), denominator(model)))
          .tail(sum.order);
  const auto offset = [](const CurveModel& of) {
    return of.theta[of.biasIndex()] / of.inverseGain();
  };
  const double bias = (offset(model) + offset(mode)) * sum.inverseGain();
  sum.theta[sum.biasIndex()] = std::isfinite(bias) ? bias : 0;
  return sum;
}

CurveModel withCancellingPair(const CurveModel& model, double pole) {
  const int n = model.order;
  CurveModel larger = model;
  larger.order = n + 1;
  larger.initial.clear();
  const Eigen::Vector2d pair(1, -pole);
  const Eigen::VectorXd a = product(withLeadingOne(model.theta.head(n)), pair);
  Eigen::VectorXd b(n + 1);
  b << model.directGain(), model.theta.segment(n, n);
  b = product(b, pair);
  const Eigen::Index rest = model.theta.size() - model.biasIndex();
  larger.theta.resize(2 * (n + 1) + (model.direct ? 1 : 0) + rest);
  larger.theta.head(n + 1) = a.tail(n + 1);
  larger.theta.segment(n + 1, n + 1) = b.tail(n + 1);
  if (model.direct) larger.theta[2 * n + 2] = b[0];
  larger.theta.tail(rest) = model.theta.tail(rest);
  return larger;
}

}  // namespace uncertainty_identification
