#include "identification/lasting_oscillations.h"

#include <Eigen/QR>
#include <cmath>
#include <complex>

#include "estimation/excerpt.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXcd;
using Eigen::VectorXd;
using Complex = std::complex<double>;

/// One pole of Go and its residue in G = ... + residue/(1 - pole q^-1).
struct Mode {
  Complex pole, residue;

  /// The mode's answer to the input, from rest.
  VectorXcd forced(const VectorXd& u, int delay) const {
    VectorXcd response(u.size());
    Complex state = 0;
    for (Index k = 0; k < u.size(); ++k) {
      state = pole * state + (k >= delay ? u[k - delay] : 0.0);
      response[k] = residue * state;
    }
    return response;
  }
};

Mode modeOf(const Polynomials& plant, const VectorXcd& poles, Index j) {
  Mode mode{poles[j], valueAt(plant.b, 1.0 / poles[j])};
  for (Index i = 0; i < poles.size(); ++i)
    if (i != j) mode.residue /= 1.0 - poles[i] / poles[j];
  return mode;
}

/// Go u, from rest.
VectorXd forcedResponse(const Polynomials& plant, const VectorXd& u) {
  VectorXd y = VectorXd::Zero(u.size());
  for (Index k = 0; k < u.size(); ++k) {
    for (Index i = 0; i < plant.b.size() && k >= plant.delay + i; ++i)
      y[k] += plant.b[i] * u[k - plant.delay - i];
    for (Index i = 0; i < plant.a.size() && k > i; ++i) y[k] -= plant.a[i] * y[k - 1 - i];
  }
  return y;
}

/// Power of the free response of a pole, fitted to the measured samples of `rest`.
double freePower(Complex pole, const VectorXd& rest, const Experiment& experiment) {
  const bool pair = std::abs(pole.imag()) > 1e-9;
  Eigen::MatrixXd shape = Eigen::MatrixXd::Zero(rest.size(), pair ? 2 : 1);
  VectorXd measured = VectorXd::Zero(rest.size());
  Complex value = 1;
  for (Index k = 0; k < rest.size(); ++k, value *= pole) {
    if (!experiment.isValid(static_cast<int>(k))) continue;
    shape(k, 0) = value.real();
    if (pair) shape(k, 1) = value.imag();
    measured[k] = rest[k];
  }
  return (shape * shape.colPivHouseholderQr().solve(measured)).squaredNorm();
}

}  // namespace

bool hasUnexcitedOscillation(const Polynomials& plant, double offset,
                             const std::vector<Experiment>& experiments) {
  const VectorXcd poles = roots(plant.a);
  for (Index j = 0; j < poles.size(); ++j) {
    if (poles[j].imag() < 0 || oscillationDecays(poles[j], longestOf(experiments))) continue;
    const Mode mode = modeOf(plant, poles, j);
    const double both = poles[j].imag() > 0 ? 2 : 1;  // with the conjugate pole
    double forced = 0, free = 0;
    for (const Experiment& experiment : experiments) {
      const VectorXd rest = (experiment.y - forcedResponse(plant, experiment.u)).array() - offset;
      forced += (both * mode.forced(experiment.u, plant.delay).real()).squaredNorm();
      free += freePower(poles[j], rest, experiment);
    }
    if (!(forced >= free)) return true;
  }
  return false;
}

}  // namespace uncertainty_identification
