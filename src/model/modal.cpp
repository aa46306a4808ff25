#include "model/modal.h"

#include <Eigen/QR>
#include <algorithm>

#include "math/polynomial.h"
#include "model/sum_of_modes.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

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

  SumOfModes modes_;
  VectorXd center_;
  MatrixXd directions_;
  Eigen::ColPivHouseholderQR<MatrixXd> inverse_;
};

}  // namespace

std::shared_ptr<const NominalModel> makeModal(const NominalModelOptions& options,
                                              double sample_time) {
  if (options.directions.size() > 0) return std::make_shared<AlongDirections>(options, sample_time);
  return std::make_shared<SumOfModes>(options, sample_time);
}

bool variesAlongDirections(const Configuration& configuration) {
  const NominalModelOptions& nominal = configuration.nominal_model;
  return nominal.structure == Structure::modal && nominal.directions.size() > 0 &&
         configuration.error_model.basis == BasisKind::parameter_spread;
}

ModalParameters modalParameters(const NominalModelOptions& options, double sample_time,
                                const VectorXd& theta) {
  if (options.structure != Structure::modal) return {};
  const SumOfModes modes(options, sample_time);
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
