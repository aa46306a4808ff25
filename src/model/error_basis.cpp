#include "uncertainty_identification/model/error_basis.h"

#include <cmath>

#include "math/polynomial.h"
#include "model/filter.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// The structure common to all bases: F_k = first[k mod m] * allpass^(k div m) / denominator^(1 + k
/// div m).
struct Chain {
  std::vector<Eigen::VectorXd> first;  ///< numerators of the m filters of one section
  Eigen::VectorXd allpass;             ///< numerator of the all-pass section
  Eigen::VectorXd denominator;         ///< monic, of one section
};

Chain chainOf(const ErrorModelOptions& options) {
  if (options.basis == BasisKind::laguerre) {
    const double p = options.pole;
    return {{Eigen::VectorXd::Constant(1, std::sqrt(1 - p * p))},
            Eigen::Vector2d(-p, 1),
            Eigen::VectorXd::Constant(1, -p)};
  }
  if (options.basis == BasisKind::kautz) {
    const double radius2 =
        options.pole_real * options.pole_real + options.pole_imag * options.pole_imag;
    const double c = -radius2, b = 2 * options.pole_real / (1 + radius2);
    const double gain = std::sqrt(1 - c * c);
    return {{gain * Eigen::Vector2d(1, -b), gain * std::sqrt(1 - b * b) * Eigen::Vector2d(0, 1)},
            Eigen::Vector3d(-c, b * (c - 1), 1),
            Eigen::Vector2d(b * (c - 1), -c)};
  }
  return {{Eigen::VectorXd::Ones(1)}, Eigen::Vector2d(0, 1), Eigen::VectorXd()};
}

Eigen::MatrixXd constraintMatrix(const ErrorModelOptions& options,
                                 const Eigen::VectorXd& static_gains) {
  const Eigen::Index taps = options.taps;
  if (options.constraint == Constraint::explicit_matrix) {
    if (options.T.rows() != taps || options.T.cols() < 1 || options.T.cols() > taps) {
      throw ConfigurationError("error_model.T: needs " + std::to_string(taps) +
                               " rows (taps) and between 1 and as many columns, found " +
                               std::to_string(options.T.rows()) + " x " +
                               std::to_string(options.T.cols()));
    }
    return options.T;
  }
  if (options.constraint != Constraint::zero_static_gain)
    return Eigen::MatrixXd::Identity(taps, taps);
  if (taps < 2) throw ConfigurationError("error_model: zero_static_gain needs at least 2 taps");
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(taps, taps - 1);
  T.topRows(taps - 1).setIdentity();
  T.row(taps - 1) = -static_gains.head(taps - 1).transpose() / static_gains[taps - 1];
  return T;
}

}  // namespace

ErrorBasis::ErrorBasis(const ErrorModelOptions& options) : options_(options), taps_(options.taps) {
  if (options_.basis == BasisKind::automatic) options_.basis = BasisKind::fir;  // not yet chosen
  if (taps_ < 0) throw ConfigurationError("error_model.taps: found auto; the basis needs a number");
  if (isStable(denominator()) == false) {
    throw ConfigurationError("error_model: the basis' pole must lie inside the unit circle");
  }
  T_ = taps_ == 0 ? Eigen::MatrixXd(0, 0) : constraintMatrix(options_, staticGains());
}

Eigen::VectorXcd ErrorBasis::responses(std::complex<double> z_inverse) const {
  const Chain chain = chainOf(options_);
  const auto at = [z_inverse](const Eigen::VectorXd& p) { return valueAt(p, z_inverse); };
  const std::complex<double> section = 1.0 + z_inverse * at(chain.denominator);
  Eigen::VectorXcd values(taps_);
  std::complex<double> allpass = 1;
  for (int k = 0; k < taps_; ++k) {
    const std::size_t within = static_cast<std::size_t>(k) % chain.first.size();
    if (k > 0 && within == 0) allpass *= at(chain.allpass) / section;
    values[k] = allpass * at(chain.first[within]) / section;
  }
  return values;
}

Eigen::VectorXd ErrorBasis::staticGains() const { return responses(1).real(); }

Eigen::VectorXd ErrorBasis::denominator() const {
  const Chain chain = chainOf(options_);
  Eigen::VectorXd product;
  for (int k = 0; k < taps_; k += static_cast<int>(chain.first.size()))
    product = multiply(product, chain.denominator);
  return product;
}

std::vector<Signals> ErrorBasis::filtered(const Signals& x) const {
  const Chain chain = chainOf(options_);
  std::vector<Signals> out(static_cast<std::size_t>(taps_));
  Signals section = x, next;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const std::size_t within = k % chain.first.size();
    if (k > 0 && within == 0) {
      filter(chain.allpass, chain.denominator, 0, section, &next);
      section.swap(next);
    }
    filter(chain.first[within], chain.denominator, 0, section, &out[k]);
  }
  return out;
}

void ErrorBasis::apply(const Signals& x, std::vector<Signals>* out) const {
  const std::vector<Signals> raw = filtered(x);
  out->resize(static_cast<std::size_t>(dimension()));
  for (int i = 0; i < dimension(); ++i) {
    Signals& regressor = (*out)[static_cast<std::size_t>(i)];
    regressor.setZero(kLanes, x.cols());
    for (int k = 0; k < taps_; ++k) {
      if (T_(k, i) != 0) addShifted(T_(k, i), 0, raw[static_cast<std::size_t>(k)], &regressor);
    }
  }
}

}  // namespace uncertainty_identification
