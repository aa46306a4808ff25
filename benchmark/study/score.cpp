#include "study/score.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace uncertainty_identification::study {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;

constexpr double kLevel = 0.95;
constexpr double kTurn = 6.283185307179586;
/// The package keeps limits in single precision, relative to Go.
constexpr double kRounding = 1e-6;

const Bands& widestOf(const UncertaintyBands& bands) {
  return bands.total.empty() ? bands.mixture : bands.total;
}

std::size_t indexOf(const std::vector<double>& levels) {
  for (std::size_t k = 0; k < levels.size(); ++k) {
    if (std::abs(levels[k] - kLevel) < 1e-9) return k;
  }
  throw std::runtime_error("the study needs bounds of level 0.95");
}

/// Whether each plant's value lies inside: plants x frequencies. The values and limits are relative
/// to their frequency's `scale`.
Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> inside(const Band& band, const ArrayXXd& values,
                                                          const ArrayXd& scale) {
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> in(values.rows(), values.cols());
  for (Index k = 0; k < values.cols(); ++k) {
    const double slack = kRounding * scale[k];
    in.col(k) = values.col(k) >= band.lower[k] - slack && values.col(k) <= band.upper[k] + slack;
  }
  return in;
}

/// Phases within half a turn of the nominal model's.
ArrayXXd phasesNear(const Eigen::VectorXd& nominal, const Eigen::MatrixXcd& fresh) {
  ArrayXXd phases(fresh.rows(), fresh.cols());
  for (Index k = 0; k < fresh.cols(); ++k) {
    for (Index r = 0; r < fresh.rows(); ++r) {
      const double away = std::arg(fresh(r, k)) - nominal[k];
      phases(r, k) = nominal[k] + away - kTurn * std::round(away / kTurn);
    }
  }
  return phases;
}

double relativeWidth(const Band& band, const ArrayXXd& magnitudes) {
  std::vector<double> ratios;
  const auto count = static_cast<double>(magnitudes.rows());
  for (Index k = 0; k < magnitudes.cols(); ++k) {
    ArrayXd sorted = magnitudes.col(k);
    std::sort(sorted.data(), sorted.data() + sorted.size());
    const auto quantile = [&](double share) {
      return sorted[static_cast<Index>(std::round(share * (count - 1)))];
    };
    const double truth = quantile((1 + kLevel) / 2) - quantile((1 - kLevel) / 2);
    if (truth > 0.01 * quantile(0.5)) ratios.push_back((band.upper[k] - band.lower[k]) / truth);
  }
  return median(ratios);
}

}  // namespace

BandScore score(const FrequencyBounds& bounds, const std::vector<double>& levels,
                const Eigen::MatrixXcd& fresh) {
  const std::size_t level = indexOf(levels);
  const ArrayXXd magnitudes = fresh.array().abs();
  const ArrayXd scale = bounds.magnitude.array().abs(), one = ArrayXd::Ones(fresh.cols());
  const Bands& bands = widestOf(bounds.magnitude_bands);
  const Band& phases = widestOf(bounds.phase_bands).pointwise.at(level);
  BandScore found;
  found.pointwise = inside(bands.pointwise.at(level), magnitudes, scale).cast<double>().mean();
  found.simultaneous =
      inside(bands.simultaneous.at(level), magnitudes, scale).rowwise().all().cast<double>().mean();
  found.phase = inside(phases, phasesNear(bounds.phase, fresh), one).cast<double>().mean();
  found.width = relativeWidth(bands.pointwise.at(level), magnitudes);
  return found;
}

double median(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double x) { return std::isnan(x); }),
               values.end());
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace uncertainty_identification::study
