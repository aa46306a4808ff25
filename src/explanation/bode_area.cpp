#include "explanation/bode_area.h"

#include <cmath>

#include "math/constants.h"
#include "uncertainty_identification/bounds/uncertainty_bounds.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {
namespace {

/// The linear part of a fit in the form that the bounds are computed from, with a sample time of 1.
Estimate linearPart(const Fit& fit) {
  const NominalModel& nominal = fit.model->nominal();
  const Polynomials p = nominal.polynomials(fit.at.parameters.head(nominal.parameterCount()));
  Estimate estimate;
  estimate.nominal_model.sample_time = 1;
  estimate.nominal_model.delay = p.delay;
  estimate.nominal_model.b = p.b;
  estimate.nominal_model.a = p.a;
  estimate.error_model.options = fit.model->basis().options();
  estimate.error_model.T = fit.model->basis().T();
  estimate.error_model.mixture = fit.at.mixture;
  return estimate;
}

}  // namespace

double bodeArea(const Fit& fit) {
  constexpr int kPoints = 40, kDraws = 1000;
  constexpr double kDecades = 3;
  const double nyquist = kPi;
  const Eigen::VectorXd omega =
      Eigen::ArrayXd::LinSpaced(kPoints, -kDecades, 0).unaryExpr([&](double decade) {
        return nyquist * std::pow(10, decade);
      });
  BoundsOptions options;
  options.levels = {0.95};
  options.samples = kDraws;
  try {
    const PlantDistribution plants(linearPart(fit));
    const FrequencyBounds bounds = frequencyBounds(plants, omega, options, 1);
    const Band& band = bounds.magnitude_bands.mixture.pointwise.front();
    return kDecades * (band.upper.array() / band.lower.array()).log10().mean();
  } catch (const DataError&) {  // the nominal model is not stable: it has no bounds
    return std::nan("");
  }
}

}  // namespace uncertainty_identification
