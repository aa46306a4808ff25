#include "own_simulation/linear_simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/polynomial.h"
#include "model/zero_order_hold.h"

namespace uncertainty_identification {
namespace {

/// y = (n0 + n1 q^-1 + ..)/(1 + a1 q^-1 + ..) u, from rest.
Eigen::VectorXd filtered(const Eigen::VectorXd& numerator, const Eigen::VectorXd& monic,
                         const Eigen::VectorXd& u) {
  Eigen::VectorXd y(u.size());
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    double sum = 0;
    for (Eigen::Index j = 0; j < std::min(numerator.size(), k + 1); ++j)
      sum += numerator[j] * u[k - j];
    for (Eigen::Index j = 0; j < std::min(monic.size(), k); ++j) sum -= monic[j] * y[k - 1 - j];
    y[k] = sum;
  }
  return y;
}

/// The mean of the held signal over each sample time, `samples` late; 0 before the beginning.
Eigen::VectorXd delayedHold(const Eigen::VectorXd& u, double samples) {
  const auto whole = static_cast<Eigen::Index>(samples);
  const double share = samples - static_cast<double>(whole);
  Eigen::VectorXd late = Eigen::VectorXd::Zero(u.size());
  for (Eigen::Index k = whole; k < u.size(); ++k)
    late[k] = (1 - share) * u[k - whole] + (k > whole ? share * u[k - whole - 1] : 0);
  return late;
}

/// The signal at the sampling instants, a little less than `samples` late.
Eigen::VectorXd delayedSamples(const Eigen::VectorXd& u, double samples) {
  return delayedHold(u, std::ceil(samples - 1e-9));
}

class LinearSimulation : public Simulation {
 public:
  LinearSimulation(LinearFactors factors, std::string description)
      : factors_(std::move(factors)), description_(std::move(description)) {}

  std::string description() const override { return description_; }
  std::vector<SimulationParameter> parameters() const override { return factors_.parameters; }
  bool canRerun() const override { return true; }

  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    if (!canBeSimulated(values))
      return Eigen::VectorXd::Constant(input.u.size(), std::numeric_limits<double>::quiet_NaN());
    return factors_.domain == TransferDomain::s ? runContinuous(input, values)
                                                : runSampled(input, values);
  }

 private:
  bool startsWith(std::size_t k, const char* kind) const {
    return factors_.parameters[k].name.rfind(kind, 0) == 0;
  }

  bool canBeSimulated(const Eigen::VectorXd& values) const {
    for (std::size_t k = 0; k < factors_.parameters.size(); ++k) {
      const double value = values[static_cast<Eigen::Index>(k)];
      if ((startsWith(k, "tau") || startsWith(k, "omega")) && !(value > 0)) return false;
      if ((startsWith(k, "zeta") || startsWith(k, "dead_time")) && !(value >= 0)) return false;
    }
    return values.allFinite();
  }

  Eigen::VectorXd runContinuous(const SimulationInput& input, const Eigen::VectorXd& values) const {
    Eigen::VectorXd numerator = factors_.fixed_numerator, denominator = factors_.fixed_denominator;
    const auto quadratic = [](double first, double second) {
      return Eigen::VectorXd(Eigen::Vector3d(1, first, second));
    };
    for (std::size_t k = 0; k < factors_.parameters.size(); ++k) {
      const double value = values[static_cast<Eigen::Index>(k)];
      if (startsWith(k, "gain")) numerator *= value;
      if (startsWith(k, "tau")) denominator = product(denominator, Eigen::Vector2d(1, value));
      if (startsWith(k, "zero")) numerator = product(numerator, Eigen::Vector2d(1, value));
      if (startsWith(k, "omega")) {
        const double damping = values[static_cast<Eigen::Index>(k) + 1];
        denominator = product(denominator, quadratic(2 * damping / value, 1 / (value * value)));
      }
    }
    for (Eigen::VectorXd* each : {&numerator, &denominator})  // the sample time is the unit of time
      for (Eigen::Index k = 1; k < each->size(); ++k)
        (*each)[k] /= std::pow(input.sample_time, static_cast<double>(k));
    return held(numerator, denominator, values[values.size() - 1] / input.sample_time, input.u);
  }

  static Eigen::VectorXd held(Eigen::VectorXd numerator, const Eigen::VectorXd& denominator,
                              double dead_samples, const Eigen::VectorXd& u) {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(u.size());
    if (numerator.size() == denominator.size()) {  // a direct term
      const double direct = numerator[numerator.size() - 1] / denominator[denominator.size() - 1];
      numerator -= direct * denominator;
      numerator.conservativeResize(numerator.size() - 1);
      y = direct * delayedSamples(u, dead_samples);
    }
    if (numerator.size() == 0) return y;
    Polynomials sampled;
    const int extra = static_cast<int>(std::ceil(dead_samples)) + 2;
    if (extra > u.size() + 2) return y;
    discretise(numerator, denominator, dead_samples, extra, &sampled);
    Eigen::VectorXd late(sampled.b.size() + 1);
    late << 0, sampled.b;
    return y + filtered(late, sampled.a, u);
  }

  Eigen::VectorXd runSampled(const SimulationInput& input, const Eigen::VectorXd& values) const {
    const double time = factors_.sample_time;
    Eigen::VectorXd poles = Eigen::VectorXd::Ones(1);
    double gain = 1;
    for (std::size_t k = 0; k < factors_.parameters.size(); ++k) {
      const double value = values[static_cast<Eigen::Index>(k)];
      if (startsWith(k, "gain")) gain *= value;
      if (startsWith(k, "tau"))
        poles = product(poles, Eigen::Vector2d(1, -std::exp(-time / value)));
      if (!startsWith(k, "omega")) continue;
      const double damping = values[static_cast<Eigen::Index>(k) + 1];
      const double radius = std::exp(-damping * value * time);
      const double rest = 1 - damping * damping;
      const double turn = value * time * std::sqrt(std::abs(rest));
      const double cosine = rest >= 0 ? std::cos(turn) : std::cosh(turn);
      poles = product(poles, Eigen::Vector3d(1, -2 * radius * cosine, radius * radius));
    }
    // Poles that have no parameter count too, but for integrators, whose static gain is infinite.
    double fixed = 1;
    for (const double root : fixedPoles()) fixed *= 1 - root;
    gain *= poles.sum() * fixed;
    const Eigen::VectorXd denominator = product(poles, factors_.fixed_denominator);
    const Eigen::VectorXd late =
        delayedHold(input.u, values[values.size() - 1] / time + factors_.delay);
    return filtered(gain * factors_.fixed_numerator, denominator.tail(denominator.size() - 1),
                    late);
  }

  std::vector<double> fixedPoles() const {
    std::vector<double> found;
    const Eigen::VectorXd& all = factors_.fixed_denominator;
    if (all.size() < 2) return found;
    const Eigen::VectorXcd poles = roots(all.tail(all.size() - 1));
    for (const auto& pole : poles)
      if (std::abs(pole - std::complex<double>(1, 0)) > 1e-4) found.push_back(pole.real());
    return found;
  }

  LinearFactors factors_;
  std::string description_;
};

}  // namespace

std::unique_ptr<Simulation> makeLinearSimulation(LinearFactors factors,
                                                 const std::string& description) {
  return std::make_unique<LinearSimulation>(std::move(factors), description);
}

}  // namespace uncertainty_identification
