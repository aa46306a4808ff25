#include "model/continuous.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"
#include "model/continuous_poles.h"
#include "model/physical_parameters.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// Number of coefficients before the first that is not zero.
double leadingZeros(const Eigen::VectorXd& b) {
  const double* first =
      std::find_if(b.data(), b.data() + b.size(), [](double value) { return value != 0; });
  return first == b.data() + b.size() ? 0 : static_cast<double>(first - b.data());
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
    const bool estimated =
        std::any_of(physical_.begin(), physical_.end(), [](const PhysicalParameter& one) {
          return one.kind == PhysicalParameter::dead_time && !one.fixed;
        });
    return estimated ? extra_ - 1 : 0;
  }

  std::vector<std::string> names() const override {
    std::vector<std::string> all;
    for (const PhysicalParameter& p : physical_) {
      if (!p.fixed) all.push_back(p.name);
    }
    for (int k = 1; k <= nc_; ++k) all.push_back("c" + std::to_string(k));
    for (int k = 1; k <= nd_; ++k) all.push_back("d" + std::to_string(k));
    return all;
  }

  std::vector<std::string> units() const override {
    std::vector<std::string> all;
    for (const PhysicalParameter& p : physical_) {
      if (!p.fixed) all.push_back(p.unit);
    }
    all.resize(names().size());
    return all;
  }

  Polynomials polynomials(const Eigen::VectorXd& theta) const override {
    Sampled<double> sampled = sampledPlant(physical_, theta, sample_time_, extra_);
    Polynomials p;
    p.delay = delay_;
    p.b = std::move(sampled.b);
    p.a = std::move(sampled.a);
    p.c = theta.segment(theta.size() - nc_ - nd_, nc_);
    p.d = theta.tail(nd_);
    return p;
  }

  /// C and D are theta's own.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& theta) const override {
    const Eigen::Index noise = nc_ + nd_, own = theta.size() - noise;
    const Eigen::MatrixXd of_plant =
        sampledJacobian(physical_, theta.head(own), sample_time_, extra_);
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(of_plant.rows() + noise, theta.size());
    all.topLeftCorner(of_plant.rows(), own) = of_plant;
    all.bottomRightCorner(noise, noise).setIdentity();
    return all;
  }

  Eigen::VectorXd toUnbounded(const Eigen::VectorXd& theta) const override {
    return mapped(theta, true);
  }
  Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& z) const override {
    return mapped(z, false);
  }

  bool admissible(const Eigen::VectorXd& theta) const override {
    const std::vector<double> value = valuesOf(physical_, theta);
    for (std::size_t k = 0; k < physical_.size(); ++k) {
      if (isPositive(physical_[k].kind) && !(value[k] > 0)) return false;
      if (physical_[k].kind == PhysicalParameter::dead_time &&
          !(value[k] >= 0 && value[k] <= maxDeadTime()))
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
    for (const PhysicalParameter& q : physical_) {
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
    const auto add = [&](PhysicalParameter::Kind kind, const std::string& name,
                         const std::string& unit) {
      const auto fixed = options.fixed.find(name);
      const bool known = fixed != options.fixed.end();
      physical_.push_back({kind, name, unit, known ? fixed->second : 0.0, known});
    };
    add(PhysicalParameter::gain, "gain", "");
    for (int k = 1; k <= options.time_constants; ++k)
      add(PhysicalParameter::time_constant, "tau" + std::to_string(k), "s");
    for (int k = 1; k <= options.resonances; ++k) {
      add(PhysicalParameter::frequency, "omega" + std::to_string(k), "rad/s");
      add(PhysicalParameter::damping, "zeta" + std::to_string(k), "1");
    }
    for (int k = 1; k <= options.zeros; ++k)
      add(PhysicalParameter::zero, "zero" + std::to_string(k), "s");
    if (options.dead_time) add(PhysicalParameter::dead_time, "dead_time", "s");
    for (const auto& [name, value] : options.fixed) {
      const bool known =
          std::any_of(physical_.begin(), physical_.end(),
                      [name = name](const PhysicalParameter& p) { return p.name == name; });
      if (!known) {
        std::string allowed;
        for (const PhysicalParameter& p : physical_)
          allowed += (allowed.empty() ? "" : ", ") + p.name;
        throw ConfigurationError("nominal_model.fixed: no parameter '" + name +
                                 "'; this structure has " + allowed);
      }
    }
  }

  /// Start value of the next parameter of this kind. Counts the poles used, so that each is used
  /// once.
  double startOf(PhysicalParameter::Kind kind, const Polynomials& p, ContinuousPoles* poles) const {
    switch (kind) {
      case PhysicalParameter::gain:
        return p.b.sum() / (1 + p.a.sum());
      case PhysicalParameter::time_constant:
        return poles->nextTimeConstant();
      case PhysicalParameter::frequency:
        return std::abs(poles->pair());
      case PhysicalParameter::damping: {
        const std::complex<double> pair = poles->pair();
        ++poles->used_pairs;
        return std::max(-pair.real() / std::abs(pair), 1e-3);
      }
      case PhysicalParameter::dead_time:
        return deadTimeOf(p);
      case PhysicalParameter::zero:
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

  static bool isPositive(PhysicalParameter::Kind kind) {
    return kind == PhysicalParameter::time_constant || kind == PhysicalParameter::frequency ||
           kind == PhysicalParameter::damping;
  }

  double maxDeadTime() const { return sample_time_ * (extra_ - 1); }

  /// Maps parameters to or from unbounded coordinates: positive parameters by the logarithm, the
  /// dead time by the logistic function, C and D by their reflection coefficients.
  Eigen::VectorXd mapped(const Eigen::VectorXd& from, bool to_unbounded) const {
    Eigen::VectorXd to = from;
    Eigen::Index next = 0;
    for (const PhysicalParameter& p : physical_) {
      if (p.fixed) continue;
      const double x = from[next];
      if (isPositive(p.kind)) to[next] = to_unbounded ? std::log(x) : std::exp(x);
      if (p.kind == PhysicalParameter::dead_time) {
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
  std::vector<PhysicalParameter> physical_;
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
