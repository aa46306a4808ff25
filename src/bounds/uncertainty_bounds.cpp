#include "uncertainty_identification/bounds/uncertainty_bounds.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <sstream>

#include "bounds/structure_bound.h"
#include "math/constants.h"
#include "math/interruption.h"
#include "math/polynomial.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXf;
using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kAtOnce = 8;          // frequencies per step: their responses fit the cache
constexpr float kResolution = 1e-5F;  // [neper], [rad], [1]: smaller differences are rounding

/// A monotone function of the angle of re + j im that is cheaper than an arc tangent. Its values go
/// from -2 (at -pi) to 2 (at pi).
ArrayXf diamondAngle(const ArrayXf& re, const ArrayXf& im) {
  const ArrayXf s = im / (re.abs() + im.abs()).max(1e-30F);
  const ArrayXf behind = (im < 0).select(-2 - s, 2 - s);
  return (re < 0).select(behind, s);
}

double angleOf(double diamond) {
  const double d = std::min(std::max(diamond, -2.0), 2.0);
  if (std::abs(d) <= 1) return std::atan2(d, 1 - std::abs(d));
  const double s = d > 0 ? 2 - d : -2 - d;
  return std::atan2(s, std::abs(s) - 1);
}

template <class Function>
void transform(Bands* bands, const Function& function) {
  for (std::vector<Band>* list : {&bands->pointwise, &bands->simultaneous}) {
    for (Band& band : *list) {
      for (Index k = 0; k < band.lower.size(); ++k) {
        band.lower[k] = function(band.lower[k], k);
        band.upper[k] = function(band.upper[k], k);
      }
    }
  }
}

struct ResponseBands {
  Bands magnitude, phase, relative_error;  ///< relative to the nominal response
};

/// The bands of G/Go over the grid: log magnitude, diamond angle (see above), |G/Go - 1|.
ResponseBands ratioBands(const PlantSamples& drawn, const PlantSamples& nominal,
                         const VectorXd& omega, const std::vector<double>& levels) {
  const int draws = drawn.count();
  BandBuilder magnitude(levels, draws, omega.size(), Sides::two, kResolution);
  BandBuilder phase(levels, draws, omega.size(), Sides::two, kResolution);
  BandBuilder error(levels, draws, omega.size(), Sides::upper, kResolution);
  ResponseSweep sweep(drawn), nominal_sweep(nominal);
  ArrayXf re, im;
  for (Index first = 0; first < omega.size(); first += kAtOnce) {
    checkpoint();
    const VectorXd at = omega.segment(first, std::min(kAtOnce, omega.size() - first));
    const ComplexResponses& all = sweep.at(at);
    const ComplexResponses& of_nominal = nominal_sweep.at(at);
    for (Index k = 0; k < at.size(); ++k) {
      const std::complex<double> inverse =
          1.0 / std::complex<double>(of_nominal.real(0, k), of_nominal.imaginary(0, k));
      re =
          (all.real.col(k).array() * inverse.real() - all.imaginary.col(k).array() * inverse.imag())
              .cast<float>();
      im =
          (all.real.col(k).array() * inverse.imag() + all.imaginary.col(k).array() * inverse.real())
              .cast<float>();
      magnitude.add(0.5F * (re * re + im * im).max(1e-36F).log());
      phase.add(diamondAngle(re, im));
      error.add(((re - 1).square() + im.square()).sqrt());
    }
  }
  return {magnitude.bands(), phase.bands(), error.bands()};
}

void requireBelowNyquist(const VectorXd& omega, double sample_time) {
  const double nyquist = kPi / sample_time;
  if (omega.size() == 0 || omega[omega.size() - 1] <= nyquist * (1 + 1e-9)) return;
  std::ostringstream message;
  message << "bounds.grid: found " << omega[omega.size() - 1]
          << " rad/s; allowed: up to the Nyquist frequency of the sample time, " << nyquist
          << " rad/s";
  throw ConfigurationError(message.str());
}

/// Writes magnitude and phase of Go; the phase includes the delay and is unwrapped from the first
/// frequency on.
void describeNominal(const PlantSamples& nominal, FrequencyBounds* bounds) {
  const ComplexResponses response = frequencyResponses(nominal, bounds->omega);
  const Index points = bounds->omega.size();
  bounds->magnitude =
      (response.real.array().square() + response.imaginary.array().square()).sqrt().matrix().row(0);
  bounds->phase.resize(points);
  const double turn = 2 * kPi;
  double last = 0;
  for (Index k = 0; k < points; ++k) {
    const double angle = std::atan2(response.imaginary(0, k), response.real(0, k));
    last = angle + turn * std::round((last - angle) / turn);
    bounds->phase[k] = last - bounds->omega[k] * nominal.sample_time * nominal.delay;
  }
}

int settlingSteps(const PlantSamples& nominal) {
  double slowest = 0;
  const VectorXd a = nominal.a.row(0).transpose();
  const Eigen::VectorXcd poles = roots(a);
  for (Index k = 0; k < poles.size(); ++k) slowest = std::max(slowest, std::abs(poles[k]));
  const double constant = slowest > 0 ? -1 / std::log(slowest) : 0;  // [samples]
  const double steps = nominal.delay + static_cast<double>(nominal.b.cols()) + 6 * constant;
  return static_cast<int>(std::min(std::max(steps, 20.0), 2000.0));
}

}  // namespace

FrequencyBounds frequencyBounds(const PlantDistribution& plants, const VectorXd& omega,
                                const BoundsOptions& options, std::uint64_t seed) {
  requireBelowNyquist(omega, plants.nominal().sample_time);
  FrequencyBounds bounds;
  bounds.omega = omega;
  describeNominal(plants.nominal(), &bounds);
  for (Uncertainty uncertainty : {Uncertainty::mixture, Uncertainty::total}) {
    if (uncertainty == Uncertainty::total && !plants.hasEstimationErrors()) continue;
    const PlantSamples drawn = plants.draw(options.samples, uncertainty, seed);
    ResponseBands found = ratioBands(drawn, plants.nominal(), omega, options.levels);
    const auto of = [uncertainty](UncertaintyBands* bands) {
      return uncertainty == Uncertainty::mixture ? &bands->mixture : &bands->total;
    };
    transform(&found.magnitude,
              [&](double x, Index k) { return bounds.magnitude[k] * std::exp(x); });
    transform(&found.phase, [&](double x, Index k) { return bounds.phase[k] + angleOf(x); });
    *of(&bounds.magnitude_bands) = std::move(found.magnitude);
    *of(&bounds.phase_bands) = std::move(found.phase);
    *of(&bounds.relative_error) = std::move(found.relative_error);
  }
  addStructureError(plants.structureError(), &bounds);
  return bounds;
}

StepBounds stepBounds(const PlantDistribution& plants, const BoundsOptions& options,
                      std::uint64_t seed) {
  const int steps = options.steps == kAutomatic ? settlingSteps(plants.nominal()) : options.steps;
  StepBounds bounds;
  bounds.time = VectorXd::LinSpaced(steps, 0, steps - 1) * plants.nominal().sample_time;
  bounds.nominal = stepResponses(plants.nominal(), steps).row(0).transpose();
  const double scale = std::max(bounds.nominal.cwiseAbs().maxCoeff(), 1e-30);
  for (Uncertainty uncertainty : {Uncertainty::mixture, Uncertainty::total}) {
    if (uncertainty == Uncertainty::total && !plants.hasEstimationErrors()) continue;
    const PlantSamples drawn = plants.draw(options.samples, uncertainty, seed);
    const Eigen::ArrayXXd responses = stepResponses(drawn, steps) / scale;
    BandBuilder builder(options.levels, drawn.count(), steps, Sides::two, kResolution);
    for (Index t = 0; t < steps; ++t) builder.add(responses.col(t).cast<float>());
    Bands bands = builder.bands();
    transform(&bands, [scale](double x, Index) { return x * scale; });
    (uncertainty == Uncertainty::mixture ? bounds.bands.mixture : bounds.bands.total) =
        std::move(bands);
  }
  return bounds;
}

}  // namespace uncertainty_identification
