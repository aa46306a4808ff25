#include "model/continuous.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"
#include "model/continuous_poles.h"
#include "model/zero_order_hold.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// A physical parameter: its name and unit in results and, by its kind, the values it may take.
struct Physical {
  enum Kind { gain, time_constant, frequency, damping, zero, dead_time } kind;
  std::string name, unit;
  double value;  ///< if fixed
  bool fixed;
};

/// Number of coefficients before the first that is not zero.
double leadingZeros(const Eigen::VectorXd& b) {
  const double* first =
      std::find_if(b.data(), b.data() + b.size(), [](double value) { return value != 0; });
  return first == b.data() + b.size() ? 0 : static_cast<double>(first - b.data());
}

/// The product of p, a polynomial in s with ascending powers, and 1 + f1 s + f2 s^2.
template <typename Scalar>
Coefficients<Scalar> times(const Coefficients<Scalar>& p, const Scalar& f1, const Scalar& f2,
                           Eigen::Index degree) {
  Coefficients<Scalar> out = Coefficients<Scalar>::Zero(p.size() + degree);
  out.head(p.size()) = p;
  out.segment(1, p.size()) += p * f1;
  if (degree == 2) out.segment(2, p.size()) += p * f2;
  return out;
}

class Continuous : public NominalModel {
 public:
  Continuous(const NominalModelOptions& options, double sample_time)
      : sample_time_(sample_time),
        delay_(options.delay),
        order_(options.time_constants + 2 * options.resonances),
        nc_(options.nc),
        nd_(options.nd),
        extra_(options.dead_time ? options.max_delay + 1 : 0) {
    if (order_ < 1 || options.zeros >= order_ || delay_ < 1) {
      throw ConfigurationError(
          "nominal_model: a continuous structure needs time_constants + 2 resonances >= 1, fewer "
          "zeros than that, "
          "and delay >= 1 (the hold's own sample)");
    }
    list(options);
  }

  std::string structure() const override { return "continuous"; }

  /// [samples]; 0 where the dead time is known or there is none.
  int longestDeadTime() const {
    const bool estimated = std::any_of(physical_.begin(), physical_.end(), [](const Physical& one) {
      return one.kind == Physical::dead_time && !one.fixed;
    });
    return estimated ? extra_ - 1 : 0;
  }

  std::vector<std::string> names() const override {
    std::vector<std::string> all;
    for (const Physical& p : physical_) {
      if (!p.fixed) all.push_back(p.name);
    }
    for (int k = 1; k <= nc_; ++k) all.push_back("c" + std::to_string(k));
    for (int k = 1; k <= nd_; ++k) all.push_back("d" + std::to_string(k));
    return all;
  }

  std::vector<std::string> units() const override {
    std::vector<std::string> all;
    for (const Physical& p : physical_) {
      if (!p.fixed) all.push_back(p.unit);
    }
    all.resize(names().size());
    return all;
  }

  /// Zero-order hold of G(s), exact for a dead time of any length. A state-space form with the
  /// sample time as unit of time is sampled; its characteristic polynomial and numerator follow by
  /// the Faddeev-LeVerrier recursion.
  Polynomials polynomials(const Eigen::VectorXd& theta) const override {
    Sampled<double> sampled = sample(values(theta));
    Polynomials p;
    p.delay = delay_;
    p.b = std::move(sampled.b);
    p.a = std::move(sampled.a);
    p.c = theta.segment(theta.size() - nc_ - nd_, nc_);
    p.d = theta.tail(nd_);
    return p;
  }

  /// Exact, by dual numbers, a few parameters at a time; C and D are theta's own.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& theta) const override {
    constexpr Eigen::Index kAtOnce = Dual::DerType::SizeAtCompileTime;
    const Eigen::Index noise = nc_ + nd_, own = theta.size() - noise;
    const Eigen::Index nb = order_ + extra_, plant = nb + order_;
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(plant + noise, theta.size());
    all.bottomRightCorner(noise, noise).setIdentity();
    for (Eigen::Index first = 0; first < own; first += kAtOnce) {
      const Eigen::Index count = std::min(kAtOnce, own - first);
      const Sampled<Dual> sampled = sample(dualValues(theta, first));
      for (Eigen::Index k = 0; k < plant; ++k) {
        const Dual& coefficient = k < nb ? sampled.b[k] : sampled.a[k - nb];
        all.row(k).segment(first, count) = coefficient.derivatives().head(count).transpose();
      }
    }
    return all;
  }

  Eigen::VectorXd toUnbounded(const Eigen::VectorXd& theta) const override {
    return mapped(theta, true);
  }
  Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& z) const override {
    return mapped(z, false);
  }

  bool admissible(const Eigen::VectorXd& theta) const override {
    const std::vector<double> value = values(theta);
    for (std::size_t k = 0; k < physical_.size(); ++k) {
      if (isPositive(physical_[k].kind) && !(value[k] > 0)) return false;
      if (physical_[k].kind == Physical::dead_time && !(value[k] >= 0 && value[k] <= maxDeadTime()))
        return false;
    }
    return NominalModel::admissible(theta);
  }

  /// Takes time constants and resonances from the poles of A, the gain from Go at frequency zero,
  /// and the dead time from the zeros that B starts with.
  Eigen::VectorXd fromPolynomials(const Polynomials& p) const override {
    ContinuousPoles poles = continuousPoles(p.a, sample_time_);
    Eigen::VectorXd theta(parameterCount());
    Eigen::Index next = 0;
    for (const Physical& q : physical_) {
      const double start = startOf(q.kind, p, &poles);
      if (!q.fixed) theta[next++] = start;
    }
    theta.tail(nc_ + nd_).setZero();
    const Eigen::Index c = std::min<Eigen::Index>(nc_, p.c.size()),
                       d = std::min<Eigen::Index>(nd_, p.d.size());
    theta.segment(next, c) = p.c.head(c);
    theta.segment(next + nc_, d) = p.d.head(d);
    return theta;
  }

 private:
  void list(const NominalModelOptions& options) {
    const auto add = [&](Physical::Kind kind, const std::string& name, const std::string& unit) {
      const auto fixed = options.fixed.find(name);
      const bool known = fixed != options.fixed.end();
      physical_.push_back({kind, name, unit, known ? fixed->second : 0.0, known});
    };
    add(Physical::gain, "gain", "");
    for (int k = 1; k <= options.time_constants; ++k)
      add(Physical::time_constant, "tau" + std::to_string(k), "s");
    for (int k = 1; k <= options.resonances; ++k) {
      add(Physical::frequency, "omega" + std::to_string(k), "rad/s");
      add(Physical::damping, "zeta" + std::to_string(k), "1");
    }
    for (int k = 1; k <= options.zeros; ++k) add(Physical::zero, "zero" + std::to_string(k), "s");
    if (options.dead_time) add(Physical::dead_time, "dead_time", "s");
    for (const auto& [name, value] : options.fixed) {
      const bool known = std::any_of(physical_.begin(), physical_.end(),
                                     [name = name](const Physical& p) { return p.name == name; });
      if (!known) {
        std::string allowed;
        for (const Physical& p : physical_) allowed += (allowed.empty() ? "" : ", ") + p.name;
        throw ConfigurationError("nominal_model.fixed: no parameter '" + name +
                                 "'; this structure has " + allowed);
      }
    }
  }

  /// Start value of the next parameter of this kind. Counts the poles used, so that each is used
  /// once.
  double startOf(Physical::Kind kind, const Polynomials& p, ContinuousPoles* poles) const {
    switch (kind) {
      case Physical::gain:
        return p.b.sum() / (1 + p.a.sum());
      case Physical::time_constant:
        return poles->nextTimeConstant();
      case Physical::frequency:
        return std::abs(poles->pair());
      case Physical::damping: {
        const std::complex<double> pair = poles->pair();
        ++poles->used_pairs;
        return std::max(-pair.real() / std::abs(pair), 1e-3);
      }
      case Physical::dead_time:
        return deadTimeOf(p);
      case Physical::zero:
        break;
    }
    return 0;
  }

  /// The dead time that makes up the delay of Go at frequency zero, beside the poles and half a
  /// sample of the hold; within the sample in which B begins.
  double deadTimeOf(const Polynomials& p) const {
    constexpr double kInside = 0.05;  // [samples] off the ends, where the likelihood has a kink
    const auto mean_lag = [](const Eigen::VectorXd& tail, double first_lag, double sum) {
      return tail.dot(Eigen::VectorXd::LinSpaced(
                 tail.size(), first_lag, first_lag + static_cast<double>(tail.size()) - 1)) /
             sum;
    };
    const double first = std::max(0.0, p.delay - delay_ + leadingZeros(p.b));
    double whole = mean_lag(p.b, p.delay, p.b.sum()) - (delay_ - 1) - 0.5;
    if (p.a.size() > 0) whole -= mean_lag(p.a, 1, 1 + p.a.sum());
    ContinuousPoles poles = continuousPoles(p.a, sample_time_);
    for (const double tau : poles.time_constants) whole -= tau / sample_time_;
    for (const std::complex<double>& pole : poles.pairs)
      whole += 2 * pole.real() / std::norm(pole) / sample_time_;
    if (!std::isfinite(whole)) whole = first + 0.5;
    const double longest = maxDeadTime() / sample_time_;
    return sample_time_ * std::min(std::clamp(whole, first + kInside, first + 1 - kInside),
                                   longest - kInside * std::min(1.0, longest));
  }

  static bool isPositive(Physical::Kind kind) {
    return kind == Physical::time_constant || kind == Physical::frequency ||
           kind == Physical::damping;
  }

  /// B and A at the values of all physical parameters.
  template <typename Scalar>
  Sampled<Scalar> sample(const std::vector<Scalar>& value) const {
    Coefficients<Scalar> numerator = Coefficients<Scalar>::Ones(1), denominator = numerator;
    Scalar dead_samples(0);
    const Scalar rate(1 / sample_time_), one(1);
    for (std::size_t k = 0; k < physical_.size(); ++k) {
      const Scalar scaled = value[k] * rate;
      switch (physical_[k].kind) {
        case Physical::gain:
          numerator *= value[k];
          break;
        case Physical::time_constant:
          denominator = times<Scalar>(denominator, scaled, Scalar(0), 1);
          break;
        case Physical::frequency: {
          const Scalar period = one / (value[k] * Scalar(sample_time_));
          const Scalar slope = Scalar(2) * value[k + 1] * period, square = period * period;
          denominator = times<Scalar>(denominator, slope, square, 2);
          break;
        }
        case Physical::zero:
          numerator = times<Scalar>(numerator, scaled, Scalar(0), 1);
          break;
        case Physical::dead_time:
          dead_samples = scaled;
          break;
        case Physical::damping:
          break;
      }
    }
    return discretise<Scalar>(numerator, denominator, dead_samples, extra_);
  }

  double maxDeadTime() const { return sample_time_ * (extra_ - 1); }

  std::vector<double> values(const Eigen::VectorXd& theta) const {
    std::vector<double> all;
    Eigen::Index next = 0;
    for (const Physical& p : physical_) all.push_back(p.fixed ? p.value : theta[next++]);
    return all;
  }

  /// The same, with the derivatives by the estimated parameters from `first` on.
  std::vector<Dual> dualValues(const Eigen::VectorXd& theta, Eigen::Index first) const {
    std::vector<Dual> all;
    Eigen::Index next = 0;
    for (const Physical& p : physical_) {
      all.emplace_back(p.fixed ? p.value : theta[next]);
      if (p.fixed) continue;
      const Eigen::Index k = next++ - first;
      if (k >= 0 && k < Dual::DerType::SizeAtCompileTime) all.back().derivatives()[k] = 1;
    }
    return all;
  }

  /// Maps parameters to or from unbounded coordinates: positive parameters by the logarithm, the
  /// dead time by the logistic function, C and D by their reflection coefficients.
  Eigen::VectorXd mapped(const Eigen::VectorXd& from, bool to_unbounded) const {
    Eigen::VectorXd to = from;
    Eigen::Index next = 0;
    for (const Physical& p : physical_) {
      if (p.fixed) continue;
      const double x = from[next];
      if (isPositive(p.kind)) to[next] = to_unbounded ? std::log(x) : std::exp(x);
      if (p.kind == Physical::dead_time) {
        to[next] =
            to_unbounded ? std::log(x / (maxDeadTime() - x)) : maxDeadTime() / (1 + std::exp(-x));
      }
      ++next;
    }
    const auto convert = [&](const Eigen::VectorXd& v) {
      return to_unbounded ? uncertainty_identification::toUnbounded(v)
                          : uncertainty_identification::fromUnbounded(v);
    };
    to.segment(next, nc_) = convert(from.segment(next, nc_));
    to.tail(nd_) = convert(from.tail(nd_));
    return to;
  }

  double sample_time_;
  int delay_, order_, nc_, nd_, extra_;
  std::vector<Physical> physical_;
};

}  // namespace

std::shared_ptr<const NominalModel> makeContinuous(const NominalModelOptions& options,
                                                   double sample_time) {
  return std::make_shared<Continuous>(options, sample_time);
}

int longestDeadTime(const NominalModel& model) {
  const auto* continuous = dynamic_cast<const Continuous*>(&model);
  return continuous == nullptr ? 0 : continuous->longestDeadTime();
}

}  // namespace uncertainty_identification
