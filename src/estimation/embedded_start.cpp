#include "estimation/embedded_start.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "math/interruption.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The numerator estimated from one experiment alone, and its information matrix.
struct OwnNumerator {
  VectorXd b;
  MatrixXd information;
};

/// Filters a signal by 1/A.
VectorXd filtered(const VectorXd& a, VectorXd signal) {
  for (Index t = 0; t < signal.size(); ++t) {
    for (Index k = 1; k <= std::min<Index>(a.size(), t); ++k) signal[t] -= a[k - 1] * signal[t - k];
  }
  return signal;
}

/// Gram matrix of [u lags, y lags 1..y_lags, y] after removing a constant. u is filtered by 1/A,
/// and so is y if it has lags.
MatrixXd gramOfRegressors(const Experiment& experiment, const VectorXd& a, int delay, Index u_lags,
                          Index y_lags, bool with_constant) {
  constexpr Index kOften = 64;  // samples
  const Index size = u_lags + y_lags + 1, samples = experiment.samples();
  const VectorXd u = filtered(a, experiment.u);
  const VectorXd y = y_lags > 0 ? filtered(a, experiment.y) : experiment.y;
  MatrixXd gram = MatrixXd::Zero(size + 1, size + 1);
  VectorXd row(size + 1);
  for (Index t = std::max(delay + u_lags, y_lags); t < samples; ++t) {
    if (t % kOften == 0) checkpoint();
    if (!experiment.isValid(static_cast<int>(t))) continue;
    for (Index k = 0; k < u_lags; ++k) row[k] = u[t - delay - k];
    for (Index k = 1; k <= y_lags; ++k) row[u_lags + k - 1] = -y[t - k];
    row[size - 1] = y[t];
    row[size] = 1;
    gram += row * row.transpose();
  }
  if (with_constant && gram(size, size) > 0) {
    const VectorXd ones = gram.col(size);
    gram -= ones * ones.transpose() / ones[size];
  }
  return gram.topLeftCorner(size, size);
}

/// Estimates A common to all experiments, each of which has its own numerator, by the
/// Steiglitz-McBride iteration. The numerators are eliminated from the regression.
VectorXd commonDenominator(const std::vector<const Experiment*>& experiments,
                           const Polynomials& sizes, Index numerator, bool with_constant) {
  constexpr int kRounds = 12;
  const Index na = sizes.a.size();
  VectorXd a = VectorXd::Zero(na);
  for (int round = 0; round < kRounds && na > 0; ++round) {
    MatrixXd sum = MatrixXd::Zero(na + 1, na + 1);
    for (const Experiment* experiment : experiments) {
      const MatrixXd gram =
          gramOfRegressors(*experiment, a, sizes.delay, numerator, na, with_constant);
      const MatrixXd cross = gram.topRightCorner(numerator, na + 1);
      sum += gram.bottomRightCorner(na + 1, na + 1) -
             cross.transpose() * gram.topLeftCorner(numerator, numerator).ldlt().solve(cross);
    }
    const VectorXd next = sum.topLeftCorner(na, na).ldlt().solve(sum.topRightCorner(na, 1));
    if (!next.allFinite()) break;
    const double change = (next - a).norm();
    a = stabilised(next, 0.9995);
    if (change < 1e-6) break;
  }
  return a;
}

bool ownNumerator(const Experiment& experiment, const Polynomials& go, bool with_constant,
                  OwnNumerator* own) {
  const Index count = go.b.size();
  const MatrixXd gram = gramOfRegressors(experiment, go.a, go.delay, count, 0, with_constant);
  own->information = gram.topLeftCorner(count, count);
  const Eigen::LDLT<MatrixXd> factor(own->information);
  own->b = factor.solve(gram.topRightCorner(count, 1));
  return factor.isPositive() && own->b.allFinite();
}

/// Matrix that multiplies B by 1 + sum_k eta_k q^-k: (nb + taps - 1) x nb.
MatrixXd productMatrix(const VectorXd& eta, Index nb) {
  MatrixXd matrix = MatrixXd::Zero(nb + eta.size() - 1, nb);
  for (Index k = 0; k < eta.size(); ++k) {
    for (Index j = 0; j < nb; ++j) matrix(j + k, j) = eta[k] + (k == 0 ? 1.0 : 0.0);
  }
  return matrix;
}

/// B and xi_r (columns), and the weighted squared distance of their products from the experiments'
/// numerators.
struct Factorisation {
  VectorXd b;
  MatrixXd xi;
  double left = 0;
};

class AlternatingLeastSquares {
 public:
  AlternatingLeastSquares(const std::vector<OwnNumerator>& own, const MatrixXd& T, Index nb)
      : own_(own), T_(T), nb_(nb) {}

  Factorisation from(const VectorXd& mean) const {
    Factorisation at{{}, mean.replicate(1, static_cast<Index>(own_.size())), 0};
    at.b = numerator(at.xi);
    return at;
  }

  void improve(int rounds, Factorisation* at) const {
    for (int round = 0; round < rounds; ++round) {
      at->left = 0;
      for (std::size_t r = 0; r < own_.size(); ++r)
        at->xi.col(static_cast<Index>(r)) = errors(own_[r], at->b, &at->left);
      at->b = numerator(at->xi);
    }
  }

 private:
  VectorXd numerator(const MatrixXd& xi) const {
    MatrixXd information = MatrixXd::Zero(nb_, nb_);
    VectorXd score = VectorXd::Zero(nb_);
    for (std::size_t r = 0; r < own_.size(); ++r) {
      checkpoint();
      const MatrixXd C = productMatrix(T_ * xi.col(static_cast<Index>(r)), nb_);
      information += C.transpose() * own_[r].information * C;
      score += C.transpose() * own_[r].information * own_[r].b;
    }
    return information.ldlt().solve(score);
  }

  VectorXd errors(const OwnNumerator& own, const VectorXd& b, double* left) const {
    const MatrixXd none = productMatrix(VectorXd::Zero(T_.rows()), nb_);
    const VectorXd rest = own.b - none * b;
    MatrixXd directions(own.b.size(), T_.cols());
    for (Index i = 0; i < T_.cols(); ++i)
      directions.col(i) = (productMatrix(T_.col(i), nb_) - none) * b;
    const MatrixXd weighted = own.information * directions;
    MatrixXd inner = directions.transpose() * weighted;
    inner.diagonal() *= 1 + 1e-9;
    const VectorXd xi = inner.ldlt().solve(weighted.transpose() * rest);
    const VectorXd distance = rest - directions * xi;
    *left += distance.dot(own.information * distance);
    return xi;
  }

  const std::vector<OwnNumerator>& own_;
  const MatrixXd& T_;
  Index nb_;
};

/// Means of xi to start from: several values along each free direction.
std::vector<VectorXd> meansToTry(Index n) {
  const std::vector<double> grid =
      n == 1 ? std::vector<double>{-1, -0.5, 0, 0.5, 1} : std::vector<double>{-0.6, 0, 0.6};
  std::vector<VectorXd> all{VectorXd::Zero(n)};
  for (Index i = 0; i < std::min<Index>(n, 2); ++i) {
    std::vector<VectorXd> more;
    for (const VectorXd& base : all) {
      for (const double value : grid) {
        more.push_back(base);
        more.back()[i] = value;
      }
    }
    all.swap(more);
  }
  return all;
}

}  // namespace

std::vector<LeastSquaresModel> embeddedStarts(const ErrorBasis& basis, const Polynomials& sizes,
                                              const std::vector<Experiment>& experiments,
                                              bool with_constant) {
  constexpr std::size_t kMost = 60, kReturned = 2;
  constexpr int kFirstRounds = 8, kLastRounds = 60;
  if (basis.kind() != BasisKind::fir || basis.dimension() == 0 || experiments.size() < 3) return {};
  const Index nb = sizes.b.size();
  std::vector<const Experiment*> used;
  const std::size_t stride = (experiments.size() + kMost - 1) / kMost;
  for (std::size_t r = 0; r < experiments.size(); r += stride)
    if (experiments[r].validSamples() == experiments[r].samples()) used.push_back(&experiments[r]);
  if (used.size() < 3) return {};
  LeastSquaresModel go;
  go.polynomials = sizes;
  go.polynomials.b = VectorXd::Zero(nb + basis.taps() - 1);
  go.polynomials.a = commonDenominator(used, sizes, go.polynomials.b.size(), with_constant);
  std::vector<OwnNumerator> own;
  for (const Experiment* experiment : used) {
    OwnNumerator numerator;
    if (ownNumerator(*experiment, go.polynomials, with_constant, &numerator))
      own.push_back(std::move(numerator));
  }
  if (own.size() < 3) return {};
  const AlternatingLeastSquares fit(own, basis.T(), nb);
  std::vector<Factorisation> tried;
  for (const VectorXd& mean : meansToTry(basis.dimension())) {
    tried.push_back(fit.from(mean));
    fit.improve(kFirstRounds, &tried.back());
  }
  std::stable_sort(tried.begin(), tried.end(),
                   [](const auto& left, const auto& right) { return left.left < right.left; });
  std::vector<LeastSquaresModel> starts;
  for (std::size_t k = 0; k < std::min(kReturned, tried.size()); ++k) {
    fit.improve(kLastRounds, &tried[k]);
    LeastSquaresModel start = go;
    start.polynomials.b = tried[k].b;
    if (start.polynomials.b.allFinite()) starts.push_back(std::move(start));
  }
  return starts;
}

}  // namespace uncertainty_identification
