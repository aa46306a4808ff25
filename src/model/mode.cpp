#include "model/mode.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"

namespace uncertainty_identification {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::VectorXd;

Mode realMode(const double* theta, double sample_time) {
  const double tau = theta[0], residue = theta[1], z = std::exp(-sample_time / tau);
  const double held = tau * -std::expm1(-sample_time / tau);  // integral of the hold
  const double z_by_tau = z * sample_time / (tau * tau);
  Mode mode;
  mode.numerator = VectorXd::Constant(1, residue * held);
  mode.denominator = VectorXd::Constant(1, -z);
  mode.numerator_derivatives = Eigen::RowVector2d(residue * (held / tau - tau * z_by_tau), held);
  mode.denominator_derivatives = Eigen::RowVector2d(-z_by_tau, 0);
  return mode;
}

Mode pairMode(const double* theta, double sample_time) {
  const double omega = theta[0], zeta = theta[1], damped = std::sqrt(1 - zeta * zeta);
  const Complex pole = omega * Complex(-zeta, damped), z = std::exp(pole * sample_time);
  const Complex direction = std::polar(1.0, theta[3]), held = (z - 1.0) / pole;
  const Complex residue = theta[2] * direction * held;
  Mode mode;
  mode.numerator = 2 * Eigen::Vector2d(residue.real(), -(residue * std::conj(z)).real());
  mode.denominator = Eigen::Vector2d(-2 * z.real(), std::norm(z));
  mode.numerator_derivatives.resize(2, 4);
  mode.denominator_derivatives.resize(2, 4);
  const Complex pole_by[] = {pole / omega, omega * Complex(-1, -zeta / damped), 0, 0};
  const Complex residue_by_pole = theta[2] * direction * (sample_time * z - held) / pole;
  const Complex residue_by[] = {residue_by_pole * pole_by[0], residue_by_pole * pole_by[1],
                                direction * held, Complex(0, 1) * residue};
  for (Index k = 0; k < 4; ++k) {
    const Complex dz = sample_time * z * pole_by[k], dr = residue_by[k];
    const Complex product = dr * std::conj(z) + residue * std::conj(dz);
    mode.numerator_derivatives.col(k) = 2 * Eigen::Vector2d(dr.real(), -product.real());
    mode.denominator_derivatives.col(k) =
        2 * Eigen::Vector2d(-dz.real(), (std::conj(z) * dz).real());
  }
  return mode;
}

ModalPoles modalPoles(const VectorXd& a, double sample_time, std::size_t reals, std::size_t pairs) {
  constexpr double kFastest = 0.05, kLongest = 1e7;  // [samples]
  constexpr double kDamped = 0.9, kApart = 1.25;
  const double fastest = kFastest * sample_time, longest = kLongest * sample_time;
  ModalPoles poles;
  const Eigen::VectorXcd all = roots(a);  // Eigen 3.3.7 has no iterators
  for (Index k = 0; k < all.size(); ++k) {
    const Complex root = all[k];
    const Complex s = std::log(root) / sample_time;
    if (std::abs(root.imag()) < 1e-9)
      poles.time_constants.push_back(
          root.real() > 0 ? std::clamp(-1 / std::min(s.real(), -1 / longest), fastest, longest)
                          : fastest);
    else if (root.imag() > 0)
      poles.pairs.emplace_back(std::min(s.real(), -1e-6 * std::abs(s)), s.imag());
  }
  std::vector<double>& constants = poles.time_constants;
  std::sort(constants.rbegin(), constants.rend());
  while (constants.size() > reals && poles.pairs.size() < pairs) {
    double product = constants.back();
    constants.pop_back();
    if (!constants.empty()) product = std::sqrt(product * constants.back()), constants.pop_back();
    poles.pairs.push_back(Complex(-kDamped, std::sqrt(1 - kDamped * kDamped)) / product);
  }
  while (constants.size() < reals) {
    const bool divides = poles.pairs.size() > pairs;
    const double constant = divides             ? 1 / std::abs(poles.pairs.back())
                            : constants.empty() ? 10 * sample_time
                                                : constants.back() / kApart;
    if (divides) poles.pairs.pop_back(), constants.push_back(constant * kApart);
    constants.push_back(divides ? constant / kApart : constant);
  }
  while (poles.pairs.size() < pairs)
    poles.pairs.push_back(Complex(-kDamped, std::sqrt(1 - kDamped * kDamped)) /
                          (constants.empty() ? 10 * sample_time : constants.front()));
  std::sort(constants.rbegin(), constants.rend());
  constants.resize(reals);
  poles.pairs.resize(pairs);
  std::sort(poles.pairs.begin(), poles.pairs.end(), [](const Complex& left, const Complex& right) {
    return std::abs(left) < std::abs(right);
  });
  return poles;
}

}  // namespace uncertainty_identification
