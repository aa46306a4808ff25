#include "detection/spread_linearity.h"

#include <cmath>
#include <complex>
#include <utility>

#include "bounds/varying_plant.h"
#include "math/constants.h"
#include "math/polynomial.h"
#include "math/symmetric_eigen.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXcd;
using Eigen::VectorXd;

/// Frequency response on a logarithmic grid up to the Nyquist frequency.
VectorXcd responseOf(const Polynomials& p) {
  constexpr int kFrequencies = 400;
  constexpr double kLowest = 1e-3;  // of the Nyquist frequency
  VectorXcd response(kFrequencies);
  for (int k = 0; k < kFrequencies; ++k) {
    const double omega = kPi * std::pow(kLowest, 1 - (k + 1.0) / kFrequencies);
    const std::complex<double> back = std::polar(1.0, -omega);
    response[k] =
        std::polar(1.0, -omega * p.delay) * valueAt(p.b, back) / valueAt(withLeadingOne(p.a), back);
  }
  return response;
}

}  // namespace

double shareBeyondFirstOrder(const Estimate& estimate,
                             std::shared_ptr<const NominalModel> nominal) {
  constexpr double kStep = 1e-3;  // standard deviations
  const VaryingPlant varying(estimate, std::move(nominal));
  const SymmetricEigen axes(estimate.error_model.mixture.covariance());
  const auto at = [&](const VectorXd& xi) {
    return responseOf(varying.plant(varying.theta(), xi));
  };
  double beyond = 0, all = 0;
  for (Eigen::Index k = 0; k < axes.eigenvalues().size(); ++k) {
    const VectorXd xi =
        axes.eigenvectors().col(k) * std::sqrt(std::max(axes.eigenvalues()[k], 0.0));
    if (!varying.exists(varying.theta(), xi) || !varying.exists(varying.theta(), -xi)) return 1;
    const VectorXcd middle = at(0 * xi), slope = (at(kStep * xi) - at(-kStep * xi)) / (2 * kStep);
    for (const double sign : {1.0, -1.0}) {
      const VectorXcd difference = at(sign * xi) - middle;
      all += difference.squaredNorm();
      beyond += (difference - sign * slope).squaredNorm();
    }
  }
  return all > 0 ? std::sqrt(beyond / all) : 0;
}

}  // namespace uncertainty_identification
