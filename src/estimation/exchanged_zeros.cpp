#include "estimation/exchanged_zeros.h"

#include <Eigen/QR>
#include <cmath>
#include <complex>
#include <map>

#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A real zero or a pair of conjugate zeros, as the monic polynomial that it is the root of.
using Factor = VectorXd;

constexpr double kTiny = 1e-9;

bool hasZeros(const VectorXd& polynomial) {
  return polynomial.size() > 0 && std::abs(polynomial[0]) > kTiny * polynomial.norm();
}

void addFactors(const VectorXd& polynomial, std::vector<Factor>* factors) {
  if (polynomial.size() < 2) return;
  const VectorXd monic = polynomial.tail(polynomial.size() - 1) / polynomial[0];
  for (const std::complex<double>& zero : listOfRoots(monic)) {
    if (std::abs(zero.imag()) < kTiny) {
      factors->push_back(VectorXd::Constant(1, -zero.real()));
    } else if (zero.imag() > 0) {
      factors->push_back(Eigen::Vector2d(-2 * zero.real(), std::norm(zero)));
    }
  }
}

/// Matrix that multiplies a polynomial of `length` coefficients by `factor`.
MatrixXd multiplication(const VectorXd& factor, Index length) {
  MatrixXd matrix = MatrixXd::Zero(factor.size() + length - 1, length);
  for (Index k = 0; k < length; ++k) matrix.col(k).segment(k, factor.size()) = factor;
  return matrix;
}

/// A mixture carried over to another numerator, and how much of B GDelta's variance that loses.
struct CarriedOver {
  Mixture mixture;
  double lost = 0;
};

/// Carries the mixture over to another numerator: xi becomes the one for which B (1 + GDelta)
/// changes least.
CarriedOver carriedOver(const Mixture& mixture, const MatrixXd& T, const VectorXd& before,
                        const VectorXd& after) {
  const MatrixXd from = multiplication(before, T.rows()), to = multiplication(after, T.rows());
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(to * T);
  const MatrixXd linear = qr.solve(from * T);
  const VectorXd constant = qr.solve((from - to).col(0));
  Mixture carried = mixture;
  const double jitter = 1e-4 * std::max(mixture.covariance().trace(), 1e-6);
  for (VectorXd& mean : carried.means) mean = linear * mean + constant;
  for (MatrixXd& covariance : carried.covariances) {
    covariance = linear * covariance * linear.transpose();
    covariance = 0.5 * (covariance + covariance.transpose()).eval();
    covariance.diagonal().array() += jitter;
  }
  const MatrixXd change = from * T - to * T * linear;
  const VectorXd shift = (from - to).col(0) - to * T * constant;
  const VectorXd mean = mixture.mean();
  return {carried, (change * mixture.covariance() * change.transpose()).trace() +
                       (change * mean + shift).squaredNorm()};
}

/// The product of the factors that `subset` names by its bits.
VectorXd productOf(const std::vector<Factor>& factors, unsigned subset) {
  VectorXd monic(0);
  for (std::size_t k = 0; k < factors.size(); ++k) {
    if (((subset >> k) & 1U) != 0) monic = multiply(monic, factors[k]);
  }
  return withLeadingOne(monic);
}

}  // namespace

std::vector<ModelParameters> withExchangedZeros(const LinearModel& model, const ModelParameters& at,
                                                Constraint constraint) {
  constexpr std::size_t kMostFactors = 12, kReturned = 6;
  const NominalModel& nominal = model.nominal();
  const Index own = nominal.parameterCount();
  const MatrixXd& T = model.basis().T();
  if (model.basis().kind() != BasisKind::fir || T.cols() == 0 || own == 0 ||
      constraint == Constraint::zero_mean)
    return {};
  Polynomials p = nominal.polynomials(at.parameters.head(own));
  VectorXd error = T * at.mixture.mean();
  error[0] += 1;
  if (!hasZeros(p.b) || !hasZeros(error)) return {};
  std::vector<Factor> factors;
  addFactors(p.b, &factors);
  const std::size_t of_b = factors.size();
  addFactors(error, &factors);
  const VectorXd before = p.b;
  if (factors.size() > kMostFactors) return {};
  const unsigned now = (1U << of_b) - 1, all = 1U << factors.size();
  std::multimap<double, ModelParameters> exchanged;  // by what is lost
  for (unsigned subset = 0; subset < all; ++subset) {
    const VectorXd zeros = productOf(factors, subset), rest = productOf(factors, all - 1 - subset);
    if (subset == now || zeros.size() != before.size() || std::abs(rest.sum()) < kTiny) continue;
    p.b = zeros * (before[0] * error[0] * rest.sum() / error.sum());
    ModelParameters point = at;
    point.parameters.head(own) = nominal.fromPolynomials(p);
    if (!model.admissible(point.parameters) ||
        !nominal.polynomials(point.parameters.head(own)).b.isApprox(p.b, 1e-6))
      continue;
    CarriedOver carried = carriedOver(at.mixture, T, before, p.b);
    point.mixture = std::move(carried.mixture);
    exchanged.emplace(carried.lost, std::move(point));
  }
  std::vector<ModelParameters> best;
  for (auto& [lost, point] : exchanged) {
    if (best.size() < kReturned) best.push_back(std::move(point));
  }
  return best;
}

}  // namespace uncertainty_identification
