#include "math/polynomial.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "math/constants.h"

namespace uncertainty_identification {
namespace {

/// tanh rounds to 1 for arguments above 18. Stay slightly below 1, so that the polynomial remains
/// strictly stable.
constexpr double kLimit = 1.0 - 1e-12;

}  // namespace

Eigen::VectorXd reflectionCoefficients(const Eigen::VectorXd& monic) {
  Eigen::VectorXd p = monic, reflection(monic.size());
  for (Eigen::Index m = monic.size(); m > 0; --m) {
    const double k = p[m - 1];
    reflection[m - 1] = k;
    const double scale = 1.0 - k * k;
    if (scale == 0.0) {
      reflection.head(m).setConstant(std::numeric_limits<double>::quiet_NaN());
      return reflection;
    }
    const Eigen::VectorXd head = p.head(m - 1);
    p.head(m - 1) = (head - k * head.reverse()) / scale;
  }
  return reflection;
}

Eigen::VectorXd fromReflection(const Eigen::VectorXd& reflection, Eigen::MatrixXd* jacobian) {
  const Eigen::Index n = reflection.size();
  Eigen::VectorXd p = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd derivative = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index m = 1; m <= n; ++m) {
    const double k = reflection[m - 1];
    const Eigen::VectorXd head = p.head(m - 1);
    const Eigen::MatrixXd rows = derivative.topRows(m - 1);
    p.head(m - 1) = head + k * head.reverse();
    p[m - 1] = k;
    derivative.topRows(m - 1) = rows + k * rows.colwise().reverse();
    derivative.col(m - 1).head(m - 1) += head.reverse();
    derivative(m - 1, m - 1) = 1.0;
  }
  if (jacobian != nullptr) *jacobian = derivative;
  return p;
}

bool isStable(const Eigen::VectorXd& monic, double radius) {
  if (!monic.allFinite()) return false;
  Eigen::VectorXd scaled = monic;  // its roots are those of `monic` divided by the radius
  for (Eigen::Index k = 0; k < monic.size(); ++k)
    scaled[k] /= std::pow(radius, static_cast<double>(k + 1));
  const Eigen::VectorXd reflection = reflectionCoefficients(scaled);
  return reflection.size() == 0 ||
         (reflection.allFinite() && reflection.cwiseAbs().maxCoeff() < 1.0);
}

Eigen::VectorXcd roots(const Eigen::VectorXd& monic) {
  const Eigen::Index n = monic.size();
  if (n == 0) return {};
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(n, n);
  companion.row(0) = -monic.transpose();
  companion.diagonal(-1).setOnes();
  return companion.eigenvalues();
}

bool oscillationDecays(std::complex<double> root, int samples) {
  const bool oscillates = std::abs(root.imag()) > 1e-9 || root.real() < 0;
  return !oscillates || std::abs(root) <= std::pow(0.05, 1.0 / samples);
}

bool oscillationsDecay(const Eigen::VectorXd& monic, int samples) {
  const Eigen::VectorXcd all = roots(monic);
  return std::all_of(all.data(), all.data() + all.size(),
                     [samples](auto root) { return oscillationDecays(root, samples); });
}

double lastingFrequency(const Eigen::VectorXd& monic, double samples, double periods) {
  constexpr double kChange = 0.1;
  if (monic.size() < 2) return 0;
  const Eigen::VectorXcd all = roots(monic);
  for (Eigen::Index k = 0; k < all.size(); ++k) {
    const double frequency = std::arg(all[k]);
    const bool oscillates = all[k].imag() > 1e-9 && frequency * samples > 2 * kPi * periods;
    const double kept = std::pow(std::abs(all[k]), samples);
    if (oscillates && kept > 1 - kChange && kept < 1 / (1 - kChange)) return frequency;
  }
  return 0;
}

Eigen::VectorXd stabilised(const Eigen::VectorXd& monic, double radius) {
  if (isStable(monic, radius)) return monic;
  Eigen::VectorXcd product = Eigen::VectorXcd::Zero(monic.size() + 1);
  product[0] = 1.0;
  for (std::complex<double> root : listOfRoots(monic)) {
    if (std::abs(root) > 1.0) root = 1.0 / std::conj(root);
    if (std::abs(root) > radius) root *= radius / std::abs(root);
    for (Eigen::Index k = monic.size(); k > 0; --k) product[k] -= root * product[k - 1];
  }
  return product.tail(monic.size()).real();
}

Eigen::VectorXd withLeadingOne(const Eigen::VectorXd& monic) {
  Eigen::VectorXd all(monic.size() + 1);
  all << 1, monic;
  return all;
}

Eigen::VectorXd product(const Eigen::VectorXd& left, const Eigen::VectorXd& right) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(left.size() + right.size() - 1);
  for (Eigen::Index i = 0; i < left.size(); ++i) all.segment(i, right.size()) += left[i] * right;
  return all;
}

std::complex<double> valueAt(const Eigen::VectorXd& polynomial, std::complex<double> z_inverse) {
  std::complex<double> value = 0;
  for (Eigen::Index k = polynomial.size() - 1; k >= 0; --k)
    value = value * z_inverse + polynomial[k];
  return value;
}

Eigen::VectorXd multiply(const Eigen::VectorXd& left, const Eigen::VectorXd& right) {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(left.size() + right.size());
  product.head(left.size()) = left;
  product.head(right.size()) += right;
  for (Eigen::Index i = 0; i < left.size(); ++i)
    product.segment(i + 1, right.size()) += left[i] * right;
  return product;
}

std::vector<std::complex<double>> listOfRoots(const Eigen::VectorXd& monic) {
  const Eigen::VectorXcd all = roots(monic);
  return {all.data(), all.data() + all.size()};
}

Eigen::VectorXd dividedBy(const Eigen::VectorXd& monic, const Eigen::VectorXd& signal) {
  Eigen::VectorXd out(signal.size());
  for (Eigen::Index k = 0; k < signal.size(); ++k) {
    double value = signal[k];
    for (Eigen::Index i = 0; i < std::min(k, monic.size()); ++i) value -= monic[i] * out[k - 1 - i];
    out[k] = value;
  }
  return out;
}

Eigen::VectorXd toUnbounded(const Eigen::VectorXd& monic) {
  const Eigen::VectorXd reflection = reflectionCoefficients(monic);
  if (reflection.size() > 0 && !(reflection.cwiseAbs().maxCoeff() < 1.0)) {
    throw std::domain_error("polynomial with a root on or outside the unit circle");
  }
  return reflection.unaryExpr([](double k) { return std::atanh(k); });
}

Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded, Eigen::MatrixXd* jacobian) {
  const Eigen::VectorXd reflection = unbounded.unaryExpr(
      [](double z) { return std::min(std::max(std::tanh(z), -kLimit), kLimit); });
  const Eigen::VectorXd p = fromReflection(reflection, jacobian);
  if (jacobian != nullptr) {
    *jacobian *= (1.0 - reflection.array().square()).matrix().asDiagonal();
  }
  return p;
}

}  // namespace uncertainty_identification
