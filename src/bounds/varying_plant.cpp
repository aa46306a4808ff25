#include "bounds/varying_plant.h"

#include <algorithm>
#include <complex>

#include "math/polynomial.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::shared_ptr<const NominalModel> nominalOf(const Estimate& estimate) {
  const NominalModelOptions& options = estimate.configuration.nominal_model;
  if (estimate.nominal_model.structure != nameOf(options.structure)) {
    throw DataError("the nominal model '" + estimate.nominal_model.structure +
                    "' was defined by the caller and the error model varies its parameters, so "
                    "the model itself must be passed");
  }
  return makeNominalModel(options, estimate.nominal_model.sample_time);
}

}  // namespace

VaryingPlant::VaryingPlant(const Estimate& estimate, std::shared_ptr<const NominalModel> nominal)
    : nominal_(nominal != nullptr ? std::move(nominal) : nominalOf(estimate)),
      basis_(estimate.error_model.options.basis),
      terms_(sensitivityTerms(*nominal_, estimate.error_model.options)),
      order_(estimate.error_model.options.sensitivity_order),
      theta_(nominal_->parameterCount()) {
  const std::vector<ParameterEstimate>& parameters = estimate.nominal_model.parameters;
  if (static_cast<Index>(parameters.size()) != theta_.size()) {
    throw DataError("the estimate has " + std::to_string(parameters.size()) +
                    " parameters and its nominal model " + std::to_string(theta_.size()));
  }
  for (Index k = 0; k < theta_.size(); ++k)
    theta_[k] = parameters[static_cast<std::size_t>(k)].value;
  const int dimension = estimate.error_model.mixture.dimension();
  if (terms_.count() != dimension) {
    throw DataError("error_model.varied_parameters: found " + std::to_string(terms_.count()) +
                    " parameters or products of them, and a mixture of dimension " +
                    std::to_string(dimension));
  }
  if (!nominal_->admissible(theta_))
    throw DataError("nominal_model.parameters: they lie outside their domain");
  if (basis_ == BasisKind::sensitivity) checkConditioning();
}

VectorXd VaryingPlant::moved(const VectorXd& theta, const VectorXd& xi) const {
  VectorXd own = theta;
  for (int i = 0; i < terms_.count(); ++i)
    own[terms_.indices[static_cast<std::size_t>(i)].front()] *= 1 + xi[i];
  return own;
}

bool VaryingPlant::exists(const VectorXd& theta, const VectorXd& xi) const {
  return nominal_->admissible(basis_ == BasisKind::parameter_spread ? moved(theta, xi) : theta);
}

Polynomials VaryingPlant::plant(const VectorXd& theta, const VectorXd& xi) const {
  if (basis_ == BasisKind::parameter_spread) return nominal_->polynomials(moved(theta, xi));
  const SensitivityNumerators rational = sensitivityNumerators(*nominal_, terms_, order_, theta);
  Polynomials sum;
  sum.delay = rational.delay;
  sum.b = rational.nominal + rational.terms * xi;
  sum.a = rational.denominator;
  return sum;
}

/// Compares the rational function with the recursion that divides by A repeatedly.
void VaryingPlant::checkConditioning() const {
  constexpr double kTolerance = 1e-6;
  const VectorXd angles = (Eigen::Vector4d() << 1e-3, 1e-2, 0.1, 1.0).finished();
  const Eigen::MatrixXcd exact = sensitivityResponses(*nominal_, terms_, theta_, angles);
  for (int i = 0; i < terms_.count(); ++i) {
    const Polynomials zero = plant(theta_, VectorXd::Zero(terms_.count()));
    const Polynomials one = plant(theta_, VectorXd::Unit(terms_.count(), i));
    for (Index k = 0; k < angles.size(); ++k) {
      const std::complex<double> shift = std::polar(1.0, -angles[k]);
      const std::complex<double> denominator = valueAt(withLeadingOne(one.a), shift);
      const std::complex<double> found =
          valueAt(one.b - zero.b, shift) / denominator *
          std::polar(1.0, -angles[k] * static_cast<double>(one.delay));
      const double scale = std::abs(exact(k, i)) + std::abs(valueAt(zero.b, shift) / denominator);
      if (std::abs(found - exact(k, i)) > kTolerance * scale) {
        throw DataError(
            "the nominal model's poles lie too near to 1 for bounds with basis sensitivity, whose "
            "denominator is a power of A; use basis parameter_spread or a longer sample time");
      }
    }
  }
}

}  // namespace uncertainty_identification
