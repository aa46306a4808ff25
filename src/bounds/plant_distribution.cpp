#include "uncertainty_identification/bounds/plant_distribution.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "bounds/spread_errors.h"
#include "bounds/varying_plant.h"
#include "estimation/plant_coordinates.h"
#include "math/distributions.h"
#include "math/interruption.h"
#include "math/polynomial.h"
#include "math/random_stream.h"
#include "math/symmetric_eigen.h"
#include "model/rational_basis.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Uniform numbers in (0, 1), count x dimensions. In each column every one of `count` equal
/// intervals contains exactly one number, in random order (McKay, Beckman, Conover 1979).
MatrixXd latinHypercube(int count, Index dimensions, std::mt19937_64* random) {
  std::uniform_real_distribution<double> within(1e-12, 1);
  MatrixXd cube(count, dimensions);
  std::vector<int> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  for (Index k = 0; k < dimensions; ++k) {
    std::shuffle(order.begin(), order.end(), *random);
    for (int i = 0; i < count; ++i)
      cube(i, k) = (order[static_cast<std::size_t>(i)] + within(*random)) / count;
  }
  return cube;
}

/// A square root of a covariance. Negative eigenvalues are due to rounding and are set to zero.
MatrixXd rootOf(const MatrixXd& covariance) {
  const SymmetricEigen eigen(covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

/// Draws xi from the mixture: `uniform` selects the component, `normals` (n) gives the deviation.
VectorXd drawError(const Mixture& mixture, double uniform, const VectorXd& normals) {
  std::size_t i = 0;
  while (i + 1 < mixture.weights.size() && uniform >= mixture.weights[i])
    uniform -= mixture.weights[i++];
  return mixture.means[i] + lowerRoot(mixture.covariances[i]) * normals;
}

/// Draws xi again as long as the parameters lie outside their domain.
void redrawUntilItExists(const VaryingPlant& varying, const Mixture& mixture, const VectorXd& at,
                         std::mt19937_64* random, VectorXd* xi) {
  constexpr int kMostDraws = 1000;
  const VectorXd theta = varying.nominal().fromUnbounded(at);
  std::uniform_real_distribution<double> uniform;
  for (int k = 0; k < kMostDraws; ++k) {
    if (varying.exists(theta, *xi)) return;
    const double component = uniform(*random);
    *xi = drawError(mixture, component, gaussian(mixture.dimension(), 1, *random));
  }
  throw DataError(
      "the spread of the parameters lies almost entirely outside their domain: no bounds can be "
      "computed");
}

VectorXd joined(const VectorXd& head, const VectorXd& tail) {
  VectorXd all(head.size() + tail.size());
  all << head, tail;
  return all;
}

PlantSamples nominalPlant(const Estimate& estimate) {
  const NominalModelEstimate& go = estimate.nominal_model;
  if (go.b.size() == 0) throw DataError("the result holds no model: B has no coefficients");
  if (!isStable(go.a))
    throw DataError("the nominal model is not stable: no bounds can be computed");
  return {go.sample_time,   go.delay,       go.b.transpose(),
          go.a.transpose(), MatrixXd(1, 0), estimate.error_model.options};
}

/// Evaluates polynomials (one per row; first coefficient is that of z^-first) at the angles.
void evaluate(const MatrixXd& coefficients, int first, const VectorXd& angles,
              ComplexResponses* values) {
  const Index powers = coefficients.cols();
  MatrixXd cosines(powers, angles.size()), sines(powers, angles.size());
  for (Index k = 0; k < powers; ++k) {
    const Eigen::ArrayXd turned = angles.array() * static_cast<double>(first + k);
    cosines.row(k) = turned.cos().matrix().transpose();
    sines.row(k) = -turned.sin().matrix().transpose();
  }
  values->real.noalias() = coefficients * cosines;
  values->imaginary.noalias() = coefficients * sines;
}

}  // namespace

PlantDistribution::PlantDistribution(const Estimate& estimate,
                                     std::shared_ptr<const NominalModel> nominal_model)
    : nominal_(nominalPlant(estimate)),
      structure_error_(estimate.structure_error),
      varying_(variesParameters(estimate.error_model.options.basis) &&
                       estimate.error_model.mixture.dimension() > 0
                   ? std::make_shared<VaryingPlant>(estimate, std::move(nominal_model))
                   : nullptr),
      basis_(estimate.error_model.options),
      T_(estimate.error_model.T),
      mixture_coordinates_(estimate.error_model.mixture.components(),
                           estimate.error_model.mixture.dimension(),
                           basis_.constraint == Constraint::zero_mean) {
  const Mixture& mixture = estimate.error_model.mixture;
  const VectorXd plant = nominalCoordinates(estimate);
  center_ =
      mixture.dimension() > 0 ? joined(plant, mixture_coordinates_.toCoordinates(mixture)) : plant;
  if (basis_.constraint == Constraint::explicit_matrix) basis_.T = T_;
  const MatrixXd& covariance = estimate.joint_covariance;
  if (covariance.rows() != center_.size() || !covariance.allFinite()) return;
  root_ = rootOf(covariance);
  const Index own = mixture.dimension() > 0 ? mixture_coordinates_.size() : 0;
  spread_errors_ = std::make_shared<SpreadErrors>(mixture, covariance.bottomRightCorner(own, own),
                                                  estimate.experiment_count);
}

VectorXd PlantDistribution::nominalCoordinates(const Estimate& estimate) const {
  return varying_ != nullptr ? varying_->nominal().toUnbounded(varying_->theta())
                             : plantCoordinates(estimate.nominal_model.b, estimate.nominal_model.a);
}

/// Writes the plant with nominal coordinates `at` and error parameters `xi` into row `row`.
void PlantDistribution::drawPlant(const VectorXd& at, const VectorXd& xi, Index row,
                                  PlantSamples* drawn) const {
  const Index nb = nominal_.b.cols(), na = nominal_.a.cols();
  if (varying_ == nullptr) {
    drawn->b.row(row) = at.head(nb).transpose();
    drawn->a.row(row) = fromUnbounded(at.segment(nb, na)).transpose();
    if (xi.size() > 0) drawn->eta.row(row) = (T_ * xi).transpose();
    return;
  }
  const Polynomials p = varying_->plant(varying_->nominal().fromUnbounded(at), xi);
  if (drawn->b.cols() != p.b.size()) drawn->b.resize(drawn->b.rows(), p.b.size());
  if (drawn->a.cols() != p.a.size()) drawn->a.resize(drawn->a.rows(), p.a.size());
  drawn->b.row(row) = p.b.transpose();
  drawn->a.row(row) = p.a.transpose();
}

void PlantDistribution::drawNominal(const VectorXd& at, Index row, PlantSamples* drawn) const {
  if (varying_ == nullptr) {
    drawPlant(at, VectorXd::Zero(T_.cols()), row, drawn);
    return;
  }
  // Not drawPlant(), which with basis sensitivity writes a power of A as denominator.
  const NominalModel& nominal = varying_->nominal();
  const Polynomials p = nominal.polynomials(nominal.fromUnbounded(at));
  drawn->b.row(row) = p.b.transpose();
  drawn->a.row(row) = p.a.transpose();
}

PlantSamples PlantDistribution::draw(int count, Uncertainty uncertainty, std::uint64_t seed) const {
  const bool nominal_only = uncertainty == Uncertainty::estimate;
  const bool total = uncertainty == Uncertainty::total || nominal_only;
  if (total && !hasEstimationErrors()) {
    throw DataError(
        "the estimation errors are not known (the estimation was cancelled, or the data do not "
        "determine them): only bounds from the mixture alone can be computed");
  }
  const Index nb = nominal_.b.cols(), na = nominal_.a.cols(), n = T_.cols();
  const Index plant = n > 0 ? center_.size() - mixture_coordinates_.size() : center_.size();
  std::mt19937_64 random = randomStream(seed, 0, RandomPurpose::plant);
  // Drawn first, so that xi is the same with and without estimation errors.
  MatrixXd own = latinHypercube(count, n > 0 ? n + 1 : 0, &random);
  if (n > 0) own.rightCols(n) = own.rightCols(n).unaryExpr(&fastNormalQuantile);
  MatrixXd errors;
  if (total)
    errors = latinHypercube(count, center_.size(), &random).unaryExpr(&fastNormalQuantile) *
             root_.transpose();
  PlantSamples drawn{nominal_.sample_time,
                     nominal_.delay,
                     MatrixXd(count, nb),
                     MatrixXd(count, na),
                     MatrixXd(count, varying_ != nullptr ? 0 : T_.rows()),
                     basis_};
  for (Index i = 0; i < count; ++i) {
    checkpoint();
    const VectorXd at = total ? VectorXd(center_ + errors.row(i).transpose()) : center_;
    if (nominal_only) {
      drawNominal(at.head(plant), i, &drawn);
      continue;
    }
    VectorXd xi;
    if (n > 0) {
      VectorXd of_mixture = at.tail(at.size() - plant);
      if (total) spread_errors_->replaceRoots(center_.tail(of_mixture.size()), &of_mixture);
      const Mixture mixture = mixture_coordinates_.fromCoordinates(of_mixture);
      xi = drawError(mixture, own(i, 0), own.row(i).tail(n).transpose());
      if (varying_ != nullptr)
        redrawUntilItExists(*varying_, mixture, at.head(plant), &random, &xi);
    }
    drawPlant(at.head(plant), xi, i, &drawn);
  }
  return drawn;
}

const ComplexResponses& ResponseSweep::at(const VectorXd& omega) {
  const VectorXd angles = omega * plants_.sample_time;
  evaluate(plants_.b, 0, angles, &numerator_);
  evaluate(plants_.a, 1, angles, &denominator_);
  denominator_.real.array() += 1;
  const auto br = numerator_.real.array(), bi = numerator_.imaginary.array();
  const auto ar = denominator_.real.array(), ai = denominator_.imaginary.array();
  scale_ = (ar * ar + ai * ai).inverse();
  response_.real = ((br * ar + bi * ai) * scale_).matrix();
  response_.imaginary = ((bi * ar - br * ai) * scale_).matrix();
  if (plants_.eta.cols() == 0) return response_;
  MatrixXd fr(plants_.eta.cols(), omega.size()), fi(plants_.eta.cols(), omega.size());
  for (Index k = 0; k < omega.size(); ++k) {
    const Eigen::VectorXcd f = basis_.responses(std::polar(1.0, -angles[k]));
    fr.col(k) = f.real();
    fi.col(k) = f.imag();
  }
  error_.real.noalias() = plants_.eta * fr;
  error_.imaginary.noalias() = plants_.eta * fi;
  error_.real.array() += 1;
  const auto er = error_.real.array(), ei = error_.imaginary.array();
  scale_ = response_.real.array() * er - response_.imaginary.array() * ei;
  response_.imaginary = (response_.real.array() * ei + response_.imaginary.array() * er).matrix();
  response_.real = scale_.matrix();
  return response_;
}

ComplexResponses frequencyResponses(const PlantSamples& plants, const VectorXd& omega) {
  return ResponseSweep(plants).at(omega);
}

Eigen::MatrixXcd delayedResponses(const PlantSamples& plants, const VectorXd& omega) {
  const ComplexResponses responses = frequencyResponses(plants, omega);
  Eigen::MatrixXcd all(plants.count(), omega.size());
  all.real() = responses.real;
  all.imag() = responses.imaginary;
  for (Index k = 0; k < omega.size(); ++k)
    all.col(k) *= std::polar(1.0, -omega[k] * plants.sample_time * plants.delay);
  return all;
}

TransferFunctions transferFunctions(const PlantSamples& plants) {
  const Index count = plants.count(), taps = plants.eta.cols(), nb = plants.b.cols();
  ErrorModelOptions options = plants.basis;
  options.taps = static_cast<int>(taps);
  options.constraint = Constraint::free;
  const RationalBasis basis{ErrorBasis(options)};
  const VectorXd of_basis = withLeadingOne(basis.denominator);
  const Index degree = std::max(of_basis.size() - 1, taps - 1);
  TransferFunctions all{MatrixXd::Zero(count, nb + degree),
                        MatrixXd(count, plants.a.cols() + of_basis.size())};
  for (Index i = 0; i < count; ++i) {
    VectorXd error = VectorXd::Zero(degree + 1);  // D_F + sum eta_k N_k
    error.head(of_basis.size()) = of_basis;
    for (Index k = 0; k < taps; ++k)
      error += plants.eta(i, k) * basis.numerators[static_cast<std::size_t>(k)];
    for (Index k = 0; k <= degree; ++k) all.num.row(i).segment(k, nb) += error[k] * plants.b.row(i);
    const VectorXd a = multiply(plants.a.row(i).transpose(), basis.denominator);
    all.den.row(i) = withLeadingOne(a).transpose();
  }
  return all;
}

Eigen::ArrayXXd stepResponses(const PlantSamples& plants, int steps) {
  Eigen::ArrayXXd input = Eigen::ArrayXXd::Ones(plants.count(), steps);
  if (plants.eta.cols() > 0) {  // The outputs of the basis filters are common to all draws.
    const std::vector<Signals> of_basis =
        ErrorBasis(plants.basis).filtered(Signals::Ones(kLanes, steps));
    for (std::size_t k = 0; k < of_basis.size(); ++k)
      input.matrix() += plants.eta.col(static_cast<Index>(k)) * of_basis[k].row(0).matrix();
  }
  Eigen::ArrayXXd y = Eigen::ArrayXXd::Zero(plants.count(), steps);
  for (Index t = plants.delay; t < steps; ++t) {
    checkpoint();
    for (Index k = 0; k < std::min(plants.b.cols(), t - plants.delay + 1); ++k)
      y.col(t) += plants.b.col(k).array() * input.col(t - plants.delay - k);
    for (Index k = 0; k < std::min(plants.a.cols(), t); ++k)
      y.col(t) -= plants.a.col(k).array() * y.col(t - 1 - k);
  }
  return y;
}

}  // namespace uncertainty_identification
