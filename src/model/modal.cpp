#include "model/modal.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>

#include "math/constants.h"
#include "math/polynomial.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A mode as a fraction in q^-1: `numerator` begins at q^-1, `denominator` is monic. The columns of
/// the derivatives are those of its parameters.
struct Mode {
  VectorXd numerator, denominator;
  MatrixXd numerator_derivatives, denominator_derivatives;
};

/// tau, residue.
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

/// omega, zeta, amplitude, phase.
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

/// The poles of a sampled plant as a modal model of given numbers of real poles and pairs has them.
/// Real poles that are too many become pairs, and the other way round.
struct Poles {
  std::vector<double> time_constants;  ///< [s] descending
  std::vector<Complex> pairs;          ///< [rad/s] by increasing frequency, imaginary part positive
};

Poles polesOf(const VectorXd& a, double sample_time, std::size_t reals, std::size_t pairs) {
  constexpr double kFastest = 0.05, kLongest = 1e7;  // [samples]
  constexpr double kDamped = 0.9, kApart = 1.25;
  const double fastest = kFastest * sample_time, longest = kLongest * sample_time;
  Poles poles;
  for (const Complex& root : roots(a)) {
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
    const double constant = divides                ? 1 / std::abs(poles.pairs.back())
                            : constants.empty()    ? 10 * sample_time
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

class Modal : public NominalModel {
 public:
  Modal(const NominalModelOptions& options, double sample_time)
      : sample_time_(sample_time),
        delay_(options.delay),
        reals_(options.time_constants),
        pairs_(options.resonances),
        nc_(options.nc),
        nd_(options.nd),
        feedthrough_(options.feedthrough) {
    if (reals_ + pairs_ < 1 || (delay_ < 1 && !feedthrough_))
      throw ConfigurationError(
          "nominal_model: a modal structure needs time_constants + resonances >= 1, and delay >= 1 "
          "or feedthrough: true");
  }

  std::string structure() const override { return "modal"; }

  std::vector<std::string> names() const override {
    std::vector<std::string> all;
    const auto add = [&all](const char* name, int k) { all.push_back(name + std::to_string(k)); };
    for (int k = 1; k <= reals_; ++k) add("tau", k), add("residue", k);
    for (int k = 1; k <= pairs_; ++k)
      add("omega", k), add("zeta", k), add("amplitude", k), add("phase", k);
    if (feedthrough_) all.emplace_back("feedthrough");
    for (int k = 1; k <= nc_; ++k) add("c", k);
    for (int k = 1; k <= nd_; ++k) add("d", k);
    return all;
  }

  std::vector<std::string> units() const override {
    std::vector<std::string> all;
    for (int k = 0; k < reals_; ++k) all.insert(all.end(), {"s", ""});
    for (int k = 0; k < pairs_; ++k) all.insert(all.end(), {"rad/s", "1", "", "rad"});
    all.resize(names().size());
    return all;
  }

  Polynomials polynomials(const VectorXd& theta) const override {
    const std::vector<Mode> modes = modesAt(theta);
    Polynomials p;
    p.delay = delay_;
    p.a = denominatorWithout(modes, {});
    p.b = VectorXd::Zero(order());
    for (Index k = 0; k < count(); ++k)
      p.b += product(modes[at(k)].numerator, withLeadingOne(denominatorWithout(modes, {k})));
    if (feedthrough_) p.b = withFeedthrough(p.b, theta[ofFeedthrough()] * withLeadingOne(p.a));
    p.c = theta.segment(theta.size() - nc_ - nd_, nc_);
    p.d = theta.tail(nd_);
    return p;
  }

  /// Each mode moves its own numerator and a factor of all others.
  MatrixXd jacobian(const VectorXd& theta) const override {
    const std::vector<Mode> modes = modesAt(theta);
    const Index nb = order() + (feedthrough_ ? 1 : 0), na = order(), noise = nc_ + nd_;
    MatrixXd all = MatrixXd::Zero(nb + na + noise, theta.size());
    for (Index k = 0, next = 0; k < count(); ++k) {
      const Mode& mode = modes[at(k)];
      const VectorXd others = withLeadingOne(denominatorWithout(modes, {k}));
      VectorXd numerators = VectorXd::Zero(order() - mode.denominator.size());
      for (Index m = 0; m < count(); ++m)
        if (m != k)
          numerators +=
              product(modes[at(m)].numerator, withLeadingOne(denominatorWithout(modes, {k, m})));
      for (Index j = 0; j < mode.numerator_derivatives.cols(); ++j, ++next) {
        const VectorXd of_a = product(mode.denominator_derivatives.col(j), others);
        VectorXd of_b = product(mode.numerator_derivatives.col(j), others);
        if (numerators.size() > 0)
          of_b.tail(of_b.size() - 1) += product(mode.denominator_derivatives.col(j), numerators);
        VectorXd later = VectorXd::Zero(order() + 1);
        later.tail(order()) = of_a;
        all.col(next).segment(nb, na) = of_a;
        all.col(next).head(nb) =
            feedthrough_ ? withFeedthrough(of_b, theta[ofFeedthrough()] * later) : of_b;
      }
    }
    if (feedthrough_)
      all.col(ofFeedthrough()).head(nb) = withLeadingOne(denominatorWithout(modes, {}));
    all.bottomRightCorner(noise, noise).setIdentity();
    return all;
  }

  VectorXd toUnbounded(const VectorXd& theta) const override {
    const auto logit = [](double share) { return std::log(share / (1 - share)); };
    VectorXd z = theta;
    for (int k = 0; k < reals_; ++k) z[2 * k] = std::log(theta[2 * k]);
    for (int k = 2 * reals_; k < 2 * reals_ + 4 * pairs_; k += 4) {
      z[k] = logit(theta[k] / highest());
      z[k + 1] = logit(theta[k + 1]);
      z[k + 2] = std::log(theta[k + 2]);
    }
    z.segment(z.size() - nc_ - nd_, nc_) =
        uncertainty_identification::toUnbounded(theta.segment(theta.size() - nc_ - nd_, nc_));
    z.tail(nd_) = uncertainty_identification::toUnbounded(theta.tail(nd_));
    return z;
  }

  VectorXd fromUnbounded(const VectorXd& z) const override {
    VectorXd theta(z.size());
    theta << ownFromUnbounded(z.head(z.size() - nc_ - nd_)),
        uncertainty_identification::fromUnbounded(z.segment(z.size() - nc_ - nd_, nc_)),
        uncertainty_identification::fromUnbounded(z.tail(nd_));
    return theta;
  }

  /// The modes' parameters without c and d.
  VectorXd ownFromUnbounded(const VectorXd& z) const {
    VectorXd theta = z;
    for (int k = 0; k < reals_; ++k) theta[2 * k] = std::exp(z[2 * k]);
    for (int k = 2 * reals_; k < 2 * reals_ + 4 * pairs_; k += 4) {
      theta[k] = highest() * share(z[k]);
      theta[k + 1] = share(z[k + 1]);
      theta[k + 2] = std::exp(z[k + 2]);
    }
    return theta;
  }

  /// Their derivatives, of which each depends on its own coordinate alone.
  MatrixXd ownByUnbounded(const VectorXd& z) const {
    const VectorXd theta = ownFromUnbounded(z);
    VectorXd slope = VectorXd::Ones(z.size());
    for (int k = 0; k < reals_; ++k) slope[2 * k] = theta[2 * k];
    for (int k = 2 * reals_; k < 2 * reals_ + 4 * pairs_; k += 4) {
      slope[k] = theta[k] * (1 - share(z[k]));
      slope[k + 1] = theta[k + 1] * (1 - share(z[k + 1]));
      slope[k + 2] = theta[k + 2];
    }
    return slope.asDiagonal();
  }

  bool admissible(const VectorXd& theta) const override {
    if (!theta.allFinite()) return false;
    for (int k = 0; k < reals_; ++k)
      if (!(theta[2 * k] > 0)) return false;
    for (int k = 2 * reals_; k < 2 * reals_ + 4 * pairs_; k += 4) {
      const bool is_pair = theta[k] > 0 && theta[k] < highest() && theta[k + 1] > 0 &&
                           theta[k + 1] < 1 && theta[k + 2] > 0;
      if (!is_pair) return false;
    }
    return NominalModel::admissible(theta);
  }

  /// Takes the poles from A, and the residues with which the frequency response is nearest.
  VectorXd fromPolynomials(const Polynomials& p) const override {
    const Poles poles =
        polesOf(p.a, sample_time_, static_cast<std::size_t>(reals_), static_cast<std::size_t>(pairs_));
    VectorXd theta = VectorXd::Zero(parameterCount());
    for (int k = 0; k < reals_; ++k) {
      theta[2 * k] = poles.time_constants[at(k)];
      theta[2 * k + 1] = 1;
    }
    for (int k = 0; k < pairs_; ++k) {
      const Complex pole = poles.pairs[at(k)];
      const double omega = std::min(std::abs(pole), 0.99 * highest());
      theta.segment<4>(2 * reals_ + 4 * k) << omega,
          std::clamp(-pole.real() / std::abs(pole), 1e-5, 0.999), 1, 0;
    }
    setResidues(p, &theta);
    const Index c = std::min<Index>(nc_, p.c.size()), d = std::min<Index>(nd_, p.d.size());
    theta.segment(theta.size() - nc_ - nd_, c) = p.c.head(c);
    theta.segment(theta.size() - nd_, d) = p.d.head(d);
    return theta;
  }

 private:
  static std::size_t at(Index k) { return static_cast<std::size_t>(k); }
  Index order() const { return reals_ + 2 * pairs_; }
  Index count() const { return reals_ + pairs_; }
  Index ofFeedthrough() const { return 2 * reals_ + 4 * pairs_; }
  double highest() const { return kPi / sample_time_; }  ///< frequency [rad/s]
  static double share(double x) { return 1 / (1 + std::exp(-x)); }

  std::vector<Mode> modesAt(const VectorXd& theta) const {
    std::vector<Mode> modes;
    for (int k = 0; k < reals_; ++k) modes.push_back(realMode(&theta[2 * k], sample_time_));
    for (int k = 0; k < pairs_; ++k)
      modes.push_back(pairMode(&theta[2 * reals_ + 4 * k], sample_time_));
    return modes;
  }

  static VectorXd denominatorWithout(const std::vector<Mode>& modes,
                                     std::initializer_list<Index> left_out) {
    VectorXd all(0);
    for (Index k = 0; k < static_cast<Index>(modes.size()); ++k)
      if (std::find(left_out.begin(), left_out.end(), k) == left_out.end())
        all = multiply(all, modes[at(k)].denominator);
    return all;
  }

  /// `direct`, and the numerator of the modes one sample later.
  static VectorXd withFeedthrough(const VectorXd& of_modes, VectorXd direct) {
    direct.tail(of_modes.size()) += of_modes;
    return direct;
  }

  /// Least squares over a grid of frequencies. G is linear in real and imaginary parts of residues.
  void setResidues(const Polynomials& p, VectorXd* theta) const {
    constexpr int kFrequencies = 100;
    constexpr double kLowest = 1e-3;  // of the Nyquist frequency
    const Index columns = order() + (feedthrough_ ? 1 : 0);
    MatrixXd regressors = MatrixXd::Zero(2 * kFrequencies, columns);
    VectorXd target(2 * kFrequencies);
    std::vector<VectorXd> points;  // theta at unit residues
    for (Index j = 0; j < columns; ++j) points.push_back(unitResidue(*theta, j));
    for (int i = 0; i < kFrequencies; ++i) {
      const double omega = kPi * std::pow(kLowest, 1 - (i + 0.5) / kFrequencies);
      const Complex back = std::polar(1.0, -omega);
      const auto set = [&](const Complex& value, auto&& row) {
        row(2 * i) = value.real();
        row(2 * i + 1) = value.imag();
      };
      set(responseOf(p, back), [&](int row) -> double& { return target[row]; });
      for (Index j = 0; j < columns; ++j)
        set(responseOf(polynomials(points[at(j)]), back),
            [&](int row) -> double& { return regressors(row, j); });
    }
    const VectorXd found = regressors.colPivHouseholderQr().solve(target);
    for (int k = 0; k < reals_; ++k) (*theta)[2 * k + 1] = found[k];
    for (int k = 0; k < pairs_; ++k) {
      const Complex residue(found[reals_ + 2 * k], found[reals_ + 2 * k + 1]);
      (*theta)[2 * reals_ + 4 * k + 2] = std::max(std::abs(residue), 1e-12);
      (*theta)[2 * reals_ + 4 * k + 3] = std::arg(residue);
    }
    if (feedthrough_) (*theta)[ofFeedthrough()] = found[columns - 1];
  }

  /// theta with the j-th real number of all residues at 1 and the others at 0.
  VectorXd unitResidue(VectorXd theta, Index j) const {
    for (int k = 0; k < reals_; ++k) theta[2 * k + 1] = j == k ? 1 : 0;
    for (int k = 0; k < pairs_; ++k) {
      const Index own = reals_ + 2 * k, at_pair = 2 * reals_ + 4 * k;
      theta[at_pair + 2] = j == own || j == own + 1 ? 1 : 0;
      theta[at_pair + 3] = j == own + 1 ? kPi / 2 : 0;
    }
    if (feedthrough_) theta[ofFeedthrough()] = j == order() ? 1 : 0;
    return theta;
  }

  static Complex responseOf(const Polynomials& p, const Complex& back) {
    return std::pow(back, p.delay) * valueAt(p.b, back) / valueAt(withLeadingOne(p.a), back);
  }

  double sample_time_;
  int delay_, reals_, pairs_, nc_, nd_;
  bool feedthrough_;
};

/// A modal model by factors along directions in its unbounded coordinates.
class AlongDirections : public NominalModel {
 public:
  AlongDirections(const NominalModelOptions& options, double sample_time)
      : modes_(options, sample_time),
        center_(options.center),
        directions_(options.directions),
        inverse_(options.directions) {
    if (center_.size() + options.nc + options.nd != modes_.parameterCount() ||
        !inverse_.isInvertible())
      throw ConfigurationError(
          "nominal_model.directions: found a singular matrix or a wrong number of parameters; give "
          "independent directions, one for each parameter of Go");
  }

  std::string structure() const override { return "modal"; }

  std::vector<std::string> names() const override {
    std::vector<std::string> all = modes_.names();
    for (Index k = 0; k < own(); ++k)
      all[static_cast<std::size_t>(k)] = "factor" + std::to_string(k + 1);
    return all;
  }

  std::vector<std::string> units() const override {
    std::vector<std::string> all = modes_.units();
    std::fill_n(all.begin(), own(), "1");
    return all;
  }

  Polynomials polynomials(const VectorXd& theta) const override {
    return modes_.polynomials(ofModes(theta));
  }

  MatrixXd jacobian(const VectorXd& theta) const override {
    MatrixXd all = modes_.jacobian(ofModes(theta));
    all.leftCols(own()) = (all.leftCols(own()) * ofModesByFactors(theta)).eval();
    return all;
  }

  /// Factors are unbounded as they are.
  VectorXd toUnbounded(const VectorXd& theta) const override {
    VectorXd z = modes_.toUnbounded(ofModes(theta));
    z.head(own()) = theta.head(own());
    return z;
  }
  VectorXd fromUnbounded(const VectorXd& z) const override {
    VectorXd of_modes = z;
    of_modes.head(own()) = coordinates(z);
    VectorXd theta = modes_.fromUnbounded(of_modes);
    theta.head(own()) = z.head(own());
    return theta;
  }

  bool admissible(const VectorXd& theta) const override {
    if (!theta.allFinite()) return false;
    const Index noise = theta.size() - own(), nc = polynomials(theta).c.size();
    return isStable(theta.tail(noise).head(nc)) && isStable(theta.tail(noise - nc)) &&
           modes_.admissible(ofModes(theta));
  }

  VectorXd fromPolynomials(const Polynomials& p) const override {
    VectorXd theta = modes_.fromPolynomials(p);
    const VectorXd z = modes_.toUnbounded(theta);
    theta.head(own()) = inverse_.solve(z.head(own()) - center_).array() + 1;
    return theta;
  }

  /// Derivatives of the modes' parameters, without c and d.
  MatrixXd ofModesByFactors(const VectorXd& theta) const {
    return modes_.ownByUnbounded(coordinates(theta)) * directions_;
  }
  VectorXd ofModes(const VectorXd& theta) const {
    VectorXd of_modes = theta;
    of_modes.head(own()) = modes_.ownFromUnbounded(coordinates(theta));
    return of_modes;
  }

 private:
  Index own() const { return center_.size(); }
  VectorXd coordinates(const VectorXd& theta) const {
    return center_ + directions_ * (theta.head(own()).array() - 1).matrix();
  }

  Modal modes_;
  VectorXd center_;
  MatrixXd directions_;
  Eigen::ColPivHouseholderQR<MatrixXd> inverse_;
};

}  // namespace

std::shared_ptr<const NominalModel> makeModal(const NominalModelOptions& options,
                                              double sample_time) {
  if (options.directions.size() > 0) return std::make_shared<AlongDirections>(options, sample_time);
  return std::make_shared<Modal>(options, sample_time);
}

ModalParameters modalParameters(const NominalModelOptions& options, double sample_time,
                                const VectorXd& theta) {
  if (options.structure != Structure::modal) return {};
  const Modal modes(options, sample_time);
  ModalParameters all{modes.names(), theta, {}};
  const Index own = theta.size() - options.nc - options.nd;
  all.by_theta = MatrixXd::Identity(own, own);
  if (options.directions.size() > 0) {
    const AlongDirections factors(options, sample_time);
    all.values = factors.ofModes(theta);
    all.by_theta = factors.ofModesByFactors(theta);
  }
  all.names.resize(static_cast<std::size_t>(own));
  all.values.conservativeResize(own);
  return all;
}

}  // namespace uncertainty_identification
