#include "own_simulation/linear_simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/polynomial.h"
#include "model/zero_order_hold.h"

namespace uncertainty_identification {
namespace {

/// The output of a filter. Of a dead time, the zeros that begin the numerator cost nothing.
Eigen::VectorXd filtered(const SampledFilter& system, const Eigen::VectorXd& u) {
  const Eigen::VectorXd &num = system.num, &den = system.den;
  Eigen::Index first = 0;
  while (first < num.size() && num[first] == 0) ++first;
  Eigen::VectorXd y(u.size());
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    double sum = 0;
    for (Eigen::Index j = first; j < std::min(num.size(), k + 1); ++j) sum += num[j] * u[k - j];
    for (Eigen::Index j = 1; j < std::min(den.size(), k + 1); ++j) sum -= den[j] * y[k - j];
    y[k] = sum;
  }
  return y;
}

/// A dead time as a filter: the mean of the held signal over each sample time, `samples` late.
Eigen::VectorXd delayFilter(double samples) {
  const auto whole = static_cast<Eigen::Index>(samples);
  const double share = samples - static_cast<double>(whole);
  Eigen::VectorXd num = Eigen::VectorXd::Zero(whole + 2);
  num[whole] = 1 - share;
  num[whole + 1] = share;
  return num;
}

Eigen::VectorXd sumOf(Eigen::VectorXd left, const Eigen::VectorXd& right) {
  const Eigen::Index size = std::max(left.size(), right.size()), from = left.size();
  left.conservativeResize(size);
  left.tail(size - from).setZero();
  left.head(right.size()) += right;
  return left;
}

class LinearSimulation : public Simulation {
 public:
  LinearSimulation(LinearFactors factors, std::string description)
      : factors_(std::move(factors)), description_(std::move(description)) {}

  std::string description() const override { return description_; }
  std::vector<SimulationParameter> parameters() const override { return factors_.parameters; }
  bool canRerun() const override { return true; }

  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    const double dead = values[values.size() - 1] / input.sample_time;
    if (canBeSimulated(values) && dead > static_cast<double>(input.u.size()))
      return Eigen::VectorXd::Zero(input.u.size());
    const std::optional<SampledFilter> system = filterAt(values, input.sample_time);
    if (!system)
      return Eigen::VectorXd::Constant(input.u.size(), std::numeric_limits<double>::quiet_NaN());
    return filtered(*system, input.u);
  }

  std::optional<SampledFilter> filterAt(const Eigen::VectorXd& values,
                                        double sample_time) const override {
    if (!canBeSimulated(values)) return std::nullopt;
    return factors_.domain == TransferDomain::s ? continuous(values, sample_time) : sampled(values);
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

  SampledFilter continuous(const Eigen::VectorXd& values, double sample_time) const {
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
        (*each)[k] /= std::pow(sample_time, static_cast<double>(k));
    return held(numerator, denominator, values[values.size() - 1] / sample_time);
  }

  static SampledFilter held(Eigen::VectorXd numerator, const Eigen::VectorXd& denominator,
                            double dead_samples) {
    SampledFilter system{Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1)};
    Eigen::VectorXd direct;  // passes a step at the first sampling instant that is not before it
    if (numerator.size() == denominator.size()) {
      const double gain = numerator[numerator.size() - 1] / denominator[denominator.size() - 1];
      numerator -= gain * denominator;
      numerator.conservativeResize(numerator.size() - 1);
      direct = gain * delayFilter(std::ceil(dead_samples - 1e-9));
    }
    if (numerator.size() > 0) {
      const int extra = static_cast<int>(std::ceil(dead_samples)) + 2;
      const Sampled<double> plant = discretise<double>(numerator, denominator, dead_samples, extra);
      system.num.resize(plant.b.size() + 1);
      system.num << 0, plant.b;
      system.den = withLeadingOne(plant.a);
    }
    if (direct.size() > 0) system.num = sumOf(system.num, product(direct, system.den));
    return system;
  }

  SampledFilter sampled(const Eigen::VectorXd& values) const {
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
    const Eigen::VectorXd late = delayFilter(values[values.size() - 1] / time + factors_.delay);
    return {gain * product(late, factors_.fixed_numerator),
            product(poles, factors_.fixed_denominator)};
  }

  std::vector<double> fixedPoles() const {
    std::vector<double> found;
    const Eigen::VectorXd& all = factors_.fixed_denominator;
    if (all.size() < 2) return found;
    for (const std::complex<double>& pole : listOfRoots(all.tail(all.size() - 1)))
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
