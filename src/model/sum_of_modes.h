#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "math/constants.h"
#include "math/polynomial.h"
#include "model/modal.h"
#include "model/mode.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

/// The nominal model of makeModal() without directions.
class SumOfModes : public NominalModel {
 public:
  SumOfModes(const NominalModelOptions& options, double sample_time)
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

  Polynomials polynomials(const Eigen::VectorXd& theta) const override {
    const std::vector<Mode> modes = modesAt(theta);
    Polynomials p;
    p.delay = delay_;
    p.a = denominatorWithout(modes, {});
    p.b = Eigen::VectorXd::Zero(order());
    for (Eigen::Index k = 0; k < count(); ++k)
      p.b += product(modes[at(k)].numerator, withLeadingOne(denominatorWithout(modes, {k})));
    if (feedthrough_) p.b = withFeedthrough(p.b, theta[ofFeedthrough()] * withLeadingOne(p.a));
    p.c = theta.segment(theta.size() - nc_ - nd_, nc_);
    p.d = theta.tail(nd_);
    return p;
  }

  /// Each mode moves its own numerator and a factor of all others.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& theta) const override {
    const std::vector<Mode> modes = modesAt(theta);
    const Eigen::Index nb = order() + (feedthrough_ ? 1 : 0), na = order(), noise = nc_ + nd_;
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(nb + na + noise, theta.size());
    for (Eigen::Index k = 0, next = 0; k < count(); ++k) {
      const Mode& mode = modes[at(k)];
      const Eigen::VectorXd others = withLeadingOne(denominatorWithout(modes, {k}));
      Eigen::VectorXd numerators = Eigen::VectorXd::Zero(order() - mode.denominator.size());
      for (Eigen::Index m = 0; m < count(); ++m)
        if (m != k)
          numerators +=
              product(modes[at(m)].numerator, withLeadingOne(denominatorWithout(modes, {k, m})));
      for (Eigen::Index j = 0; j < mode.numerator_derivatives.cols(); ++j, ++next) {
        const Eigen::VectorXd of_a = product(mode.denominator_derivatives.col(j), others);
        Eigen::VectorXd of_b = product(mode.numerator_derivatives.col(j), others);
        if (numerators.size() > 0)
          of_b.tail(of_b.size() - 1) += product(mode.denominator_derivatives.col(j), numerators);
        Eigen::VectorXd later = Eigen::VectorXd::Zero(order() + 1);
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

  Eigen::VectorXd toUnbounded(const Eigen::VectorXd& theta) const override {
    const auto logit = [](double share) { return std::log(share / (1 - share)); };
    Eigen::VectorXd z = theta;
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

  Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& z) const override {
    Eigen::VectorXd theta(z.size());
    theta << ownFromUnbounded(z.head(z.size() - nc_ - nd_)),
        uncertainty_identification::fromUnbounded(z.segment(z.size() - nc_ - nd_, nc_)),
        uncertainty_identification::fromUnbounded(z.tail(nd_));
    return theta;
  }

  /// The modes' parameters without c and d.
  Eigen::VectorXd ownFromUnbounded(const Eigen::VectorXd& z) const {
    Eigen::VectorXd theta = z;
    for (int k = 0; k < reals_; ++k) theta[2 * k] = std::exp(z[2 * k]);
    for (int k = 2 * reals_; k < 2 * reals_ + 4 * pairs_; k += 4) {
      theta[k] = highest() * share(z[k]);
      theta[k + 1] = share(z[k + 1]);
      theta[k + 2] = std::exp(z[k + 2]);
    }
    return theta;
  }

  /// Their derivatives, of which each depends on its own coordinate alone.
  Eigen::MatrixXd ownByUnbounded(const Eigen::VectorXd& z) const {
    const Eigen::VectorXd theta = ownFromUnbounded(z);
    Eigen::VectorXd slope = Eigen::VectorXd::Ones(z.size());
    for (int k = 0; k < reals_; ++k) slope[2 * k] = theta[2 * k];
    for (int k = 2 * reals_; k < 2 * reals_ + 4 * pairs_; k += 4) {
      slope[k] = theta[k] * (1 - share(z[k]));
      slope[k + 1] = theta[k + 1] * (1 - share(z[k + 1]));
      slope[k + 2] = theta[k + 2];
    }
    return slope.asDiagonal();
  }

  bool admissible(const Eigen::VectorXd& theta) const override {
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
  Eigen::VectorXd fromPolynomials(const Polynomials& p) const override {
    const ModalPoles poles = modalPoles(p.a, sample_time_, static_cast<std::size_t>(reals_),
                                        static_cast<std::size_t>(pairs_));
    Eigen::VectorXd theta = Eigen::VectorXd::Zero(parameterCount());
    for (int k = 0; k < reals_; ++k) {
      theta[2 * k] = poles.time_constants[at(k)];
      theta[2 * k + 1] = 1;
    }
    for (int k = 0; k < pairs_; ++k) {
      const std::complex<double> pole = poles.pairs[at(k)];
      const double omega = std::min(std::abs(pole), 0.99 * highest());
      theta.segment<4>(2 * reals_ + 4 * k) << omega,
          std::clamp(-pole.real() / std::abs(pole), 1e-5, 0.999), 1, 0;
    }
    setResidues(p, &theta);
    const Eigen::Index c = std::min<Eigen::Index>(nc_, p.c.size()),
                       d = std::min<Eigen::Index>(nd_, p.d.size());
    theta.segment(theta.size() - nc_ - nd_, c) = p.c.head(c);
    theta.segment(theta.size() - nd_, d) = p.d.head(d);
    return theta;
  }

 private:
  static std::size_t at(Eigen::Index k) { return static_cast<std::size_t>(k); }
  Eigen::Index order() const { return reals_ + 2 * pairs_; }
  Eigen::Index count() const { return reals_ + pairs_; }
  Eigen::Index ofFeedthrough() const { return 2 * reals_ + 4 * pairs_; }
  double highest() const { return kPi / sample_time_; }  ///< frequency [rad/s]
  static double share(double x) { return 1 / (1 + std::exp(-x)); }

  std::vector<Mode> modesAt(const Eigen::VectorXd& theta) const {
    std::vector<Mode> modes;
    modes.reserve(at(count()));
    for (int k = 0; k < reals_; ++k) modes.push_back(realMode(&theta[2 * k], sample_time_));
    for (int k = 0; k < pairs_; ++k)
      modes.push_back(pairMode(&theta[2 * reals_ + 4 * k], sample_time_));
    return modes;
  }

  static Eigen::VectorXd denominatorWithout(const std::vector<Mode>& modes,
                                            std::initializer_list<Eigen::Index> left_out) {
    Eigen::VectorXd all(0);
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(modes.size()); ++k)
      if (std::find(left_out.begin(), left_out.end(), k) == left_out.end())
        all = multiply(all, modes[at(k)].denominator);
    return all;
  }

  /// `direct`, and the numerator of the modes one sample later.
  static Eigen::VectorXd withFeedthrough(const Eigen::VectorXd& of_modes, Eigen::VectorXd direct) {
    direct.tail(of_modes.size()) += of_modes;
    return direct;
  }

  /// Least squares over a grid of frequencies. G is linear in real and imaginary parts of residues.
  void setResidues(const Polynomials& p, Eigen::VectorXd* theta) const {
    constexpr int kFrequencies = 100;
    constexpr double kLowest = 1e-3;  // of the Nyquist frequency
    const Eigen::Index columns = order() + (feedthrough_ ? 1 : 0);
    Eigen::MatrixXd regressors = Eigen::MatrixXd::Zero(2 * kFrequencies, columns);
    Eigen::VectorXd target(2 * kFrequencies);
    std::vector<Eigen::VectorXd> points;  // theta at unit residues
    for (Eigen::Index j = 0; j < columns; ++j) points.push_back(unitResidue(*theta, j));
    for (int i = 0; i < kFrequencies; ++i) {
      const double omega = kPi * std::pow(kLowest, 1 - (i + 0.5) / kFrequencies);
      const std::complex<double> back = std::polar(1.0, -omega);
      const auto set = [&](const std::complex<double>& value, auto&& row) {
        row(2 * i) = value.real();
        row(2 * i + 1) = value.imag();
      };
      set(responseOf(p, back), [&](int row) -> double& { return target[row]; });
      for (Eigen::Index j = 0; j < columns; ++j)
        set(responseOf(polynomials(points[at(j)]), back),
            [&](int row) -> double& { return regressors(row, j); });
    }
    const Eigen::VectorXd found = regressors.colPivHouseholderQr().solve(target);
    for (int k = 0; k < reals_; ++k) (*theta)[2 * k + 1] = found[k];
    for (int k = 0; k < pairs_; ++k) {
      const std::complex<double> residue(found[reals_ + 2 * k], found[reals_ + 2 * k + 1]);
      (*theta)[2 * reals_ + 4 * k + 2] = std::max(std::abs(residue), 1e-12);
      (*theta)[2 * reals_ + 4 * k + 3] = std::arg(residue);
    }
    if (feedthrough_) (*theta)[ofFeedthrough()] = found[columns - 1];
  }

  /// theta with the j-th real number of all residues at 1 and the others at 0.
  Eigen::VectorXd unitResidue(Eigen::VectorXd theta, Eigen::Index j) const {
    for (int k = 0; k < reals_; ++k) theta[2 * k + 1] = j == k ? 1 : 0;
    for (int k = 0; k < pairs_; ++k) {
      const Eigen::Index own = reals_ + 2 * k, at_pair = 2 * reals_ + 4 * k;
      theta[at_pair + 2] = j == own || j == own + 1 ? 1 : 0;
      theta[at_pair + 3] = j == own + 1 ? kPi / 2 : 0;
    }
    if (feedthrough_) theta[ofFeedthrough()] = j == order() ? 1 : 0;
    return theta;
  }

  static std::complex<double> responseOf(const Polynomials& p, const std::complex<double>& back) {
    return std::pow(back, p.delay) * valueAt(p.b, back) / valueAt(withLeadingOne(p.a), back);
  }

  double sample_time_;
  int delay_, reals_, pairs_, nc_, nd_;
  bool feedthrough_;
};

}  // namespace uncertainty_identification
