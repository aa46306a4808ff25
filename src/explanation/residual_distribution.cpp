#include "explanation/residual_distribution.h"

#include <algorithm>
#include <cmath>

#include "explanation/after_input_changes.h"
#include "math/constants.h"
#include "math/distributions.h"
#include "math/polynomial.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

/// The residuals of all measured samples.
ArrayXd pooled(const Residuals& residuals, const FitData& data) {
  std::vector<double> values;
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    const Block& block = data.blocks()[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      for (int t = 0; t < block.lengths[static_cast<std::size_t>(lane)]; ++t)
        if (block.weight(lane, t) > 0) values.push_back(residuals.standardised[b](lane, t));
    }
  }
  return Eigen::Map<const ArrayXd>(values.data(), static_cast<Index>(values.size()));
}

/// Standard deviation estimated by the median absolute value, which outliers hardly change.
double robustDeviation(const ArrayXd& values) {
  std::vector<double> sizes(values.size() > 0 ? static_cast<std::size_t>(values.size()) : 1);
  for (Index k = 0; k < values.size(); ++k)
    sizes[static_cast<std::size_t>(k)] = std::abs(values[k]);
  std::nth_element(sizes.begin(), sizes.begin() + static_cast<long>(sizes.size() / 2), sizes.end());
  return std::max(sizes[sizes.size() / 2] / 0.6745, 1e-300);
}

ArrayXd logNormal(const ArrayXd& r, double deviation) {
  return -0.5 * std::log(2 * kPi) - std::log(deviation) - 0.5 * (r / deviation).square();
}

/// Log density of each value under Student's t distribution with so many degrees of freedom.
/// `scale` is where the fit of the scale starts, and is set to the fitted one.
ArrayXd logStudent(const ArrayXd& r, double degrees, double* scale) {
  constexpr int kSteps = 12;
  for (int k = 0; k < kSteps; ++k) {
    const ArrayXd weight = (degrees + 1) / (degrees + (r / *scale).square());
    *scale = std::sqrt((weight * r.square()).mean());
  }
  const double constant = std::lgamma((degrees + 1) / 2) - std::lgamma(degrees / 2) -
                          0.5 * std::log(degrees * kPi) - std::log(*scale);
  return constant - (degrees + 1) / 2 * (1 + (r / *scale).square() / degrees).log();
}

/// ln(exp(a) + exp(b)) of each element without overflow.
ArrayXd logSum(const ArrayXd& a, const ArrayXd& b) {
  const ArrayXd larger = a.max(b);
  return larger + ((a - larger).exp() + (b - larger).exp()).log();
}

void fitStudent(const ArrayXd& r, ResidualDistribution* distribution) {
  const double deviation = std::sqrt(r.square().mean());
  const double gaussian = logNormal(r, deviation).sum();
  for (const double degrees : {2.2, 2.6, 3.0, 3.5, 4.0, 5.0, 6.0, 8.0, 10.0, 15.0, 25.0}) {
    double scale = deviation * std::sqrt(std::max(degrees - 2, 0.1) / degrees);
    const double gain = logStudent(r, degrees, &scale).sum() - gaussian;
    if (gain <= distribution->student_gain) continue;
    distribution->student_gain = gain;
    distribution->degrees = degrees;
  }
}

void fitMixtureOfTwo(const ArrayXd& r, ResidualDistribution* distribution) {
  constexpr int kSteps = 60;
  const double gaussian = logNormal(r, std::sqrt(r.square().mean())).sum();
  double share = 0.02, narrow = robustDeviation(r), wide = 4 * narrow, value = 0;
  for (int k = 0; k < kSteps; ++k) {
    const ArrayXd a = std::log(share) + logNormal(r, wide);
    const ArrayXd b = std::log(1 - share) + logNormal(r, narrow);
    const ArrayXd all = logSum(a, b), weight = (a - all).exp();
    value = all.sum();
    share = std::clamp(weight.mean(), 1e-5, 0.3);
    wide = std::sqrt((weight * r.square()).sum() / std::max(weight.sum(), 1e-12));
    narrow = std::sqrt(((1 - weight) * r.square()).sum() / (1 - weight).sum());
  }
  distribution->mixture_gain = value - gaussian;
  distribution->share = share;
  distribution->ratio = wide / narrow;
}

/// p-value of the number of pairs of marked samples at most kReach apart, which is a Poisson
/// variable where the marked samples are independent.
double clusteringOf(const std::vector<Signals>& marked, double samples) {
  constexpr int kReach = 3;
  double count = 0, pairs = 0;
  for (const Signals& signal : marked) {
    count += signal.sum();
    for (int k = 1; k <= kReach && k < signal.cols(); ++k)
      pairs += (signal.leftCols(signal.cols() - k) * signal.rightCols(signal.cols() - k)).sum();
  }
  const double expected = kReach * samples * std::pow(count / samples, 2);
  if (pairs < 1 || expected <= 0) return 1;
  return poissonTail(pairs - 1, expected);
}

/// Chen and Liu's search for additive outliers: residuals are correlated with the impulse response
/// of the whitening, and the largest correlations are removed until none is large.
void findAdditive(const Fit& fit, const FitData& data, const Residuals& residuals, double deviation,
                  ResidualDistribution* distribution) {
  const Polynomials p = fit.model->nominal().polynomials(
      fit.at.parameters.head(fit.model->nominal().parameterCount()));
  if (p.c.size() + p.d.size() == 0) return;
  constexpr int kLongest = 12, kRounds = 12;
  constexpr double kLarge = 4;
  Signals impulse = Signals::Zero(kLanes, kLongest), response;
  impulse.col(0).setOnes();
  filter(withLeadingOne(p.d), p.c, 0, impulse, &response);
  VectorXd footprint = response.row(0).matrix();
  Index length = 1;
  for (Index k = 0; k < kLongest; ++k)
    if (std::abs(footprint[k]) > 0.02) length = k + 1;
  footprint.conservativeResize(length);
  const double power = footprint.squaredNorm();
  double before = 0, after = 0, count = 0, samples = 0;
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    Signals r = residuals.standardised[b], found = Signals::Zero(r.rows(), r.cols());
    before += r.square().sum();
    for (int round = 0; round < kRounds; ++round) {
      Signals size = Signals::Zero(r.rows(), r.cols());
      for (Index k = 0; k < length && k < r.cols(); ++k)
        size.leftCols(r.cols() - k) += footprint[k] / power * r.rightCols(r.cols() - k);
      const Signals score = size.abs() * (std::sqrt(power) / deviation);
      Signals hit = Signals::Zero(r.rows(), r.cols());
      for (Index t = 0; t < r.cols(); ++t) {
        const Index first = std::max<Index>(0, t - length),
                    last = std::min(r.cols() - 1, t + length);
        const Lanes highest = score.middleCols(first, last - first + 1).rowwise().maxCoeff();
        hit.col(t) =
            (score.col(t) > kLarge && score.col(t) >= highest && found.col(t) == 0).cast<double>();
      }
      hit *= data.blocks()[b].weight;
      if ((hit == 0).all()) break;
      found += hit;
      const Signals taken = hit * size;
      for (Index k = 0; k < length; ++k)
        r.rightCols(r.cols() - k) -= footprint[k] * taken.leftCols(r.cols() - k);
    }
    after += r.square().sum();
    count += found.sum();
    samples += data.blocks()[b].weight.sum();
    distribution->found.push_back(std::move(found));
  }
  const double cost = std::log(1 / 0.02) + 0.5 * std::log(60.0);  // of stating time and size
  distribution->additive_gain =
      0.5 * samples * std::log(before / std::max(after, 1e-300)) - cost * count;
}

}  // namespace

bool ResidualDistribution::areAdditive() const {
  return additive_gain > 0.8 * mixture_gain && !found.empty();
}

ResidualDistribution residualDistribution(const Fit& fit, const FitData& data,
                                          const Residuals& residuals) {
  ResidualDistribution distribution;
  const ArrayXd r = pooled(residuals, data);
  const double deviation = robustDeviation(r);
  fitStudent(r, &distribution);
  fitMixtureOfTwo(r, &distribution);
  findAdditive(fit, data, residuals, deviation, &distribution);
  std::vector<Signals> marked;
  for (const Signals& signal : residuals.standardised)
    marked.push_back((signal.abs() > 4 * deviation).cast<double>());
  distribution.clustering = clusteringOf(distribution.areAdditive() ? distribution.found : marked,
                                         static_cast<double>(r.size()));
  const NominalModel& nominal = fit.model->nominal();
  const int delay = nominal.polynomials(fit.at.parameters.head(nominal.parameterCount())).delay;
  distribution.after_changes = afterInputChanges(marked, data, delay);
  distribution.by_changes = sizeByChanges(residuals.standardised, data, delay);
  return distribution;
}

bool isResidualDistribution(const Effect& effect) {
  return effect.has(Trait::heavy_tails) || effect.has(Trait::outliers);
}

DistributionFamily familyOf(const Effect& effect) {
  return effect.has(Trait::heavy_tails) ? DistributionFamily::student : DistributionFamily::mixture;
}

VectorXd distributionGain(const ResidualDistribution& distribution, DistributionFamily family,
                          const Residuals& residuals, const FitData& data) {
  VectorXd gain = VectorXd::Zero(data.count());
  const ArrayXd all = pooled(residuals, data);
  const double deviation = std::sqrt(all.square().mean());
  double scale = deviation * std::sqrt(std::max(distribution.degrees - 2, 0.1) /
                                       std::max(distribution.degrees, 1.0));
  if (family == DistributionFamily::student) logStudent(all, distribution.degrees, &scale);
  const double narrow =
      deviation / std::sqrt(1 - distribution.share +
                            distribution.share * distribution.ratio * distribution.ratio);
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    const Block& block = data.blocks()[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      const ArrayXd r = residuals.standardised[b].row(lane).transpose();
      ArrayXd density;
      if (family == DistributionFamily::student) {
        const double constant = std::lgamma((distribution.degrees + 1) / 2) -
                                std::lgamma(distribution.degrees / 2) -
                                0.5 * std::log(distribution.degrees * kPi) - std::log(scale);
        density = constant - (distribution.degrees + 1) / 2 *
                                 (1 + (r / scale).square() / distribution.degrees).log();
      } else {
        density = logSum(std::log(distribution.share) + logNormal(r, narrow * distribution.ratio),
                         std::log(1 - distribution.share) + logNormal(r, narrow));
      }
      const ArrayXd weight = block.weight.row(lane).transpose();
      gain[block.index[static_cast<std::size_t>(lane)]] =
          (weight * (density - logNormal(r, deviation))).sum();
    }
  }
  return gain;
}

std::vector<Experiment> withoutOutliers(const FitData& data, const Residuals& residuals,
                                        const ResidualDistribution& distribution) {
  constexpr double kLarge = 4.5;
  const double deviation = robustDeviation(pooled(residuals, data));
  const bool additive = distribution.areAdditive();
  std::vector<Experiment> experiments = data.experiments();
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    const Block& block = data.blocks()[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      Experiment& experiment =
          experiments[static_cast<std::size_t>(block.index[static_cast<std::size_t>(lane)])];
      std::vector<std::uint8_t> valid(static_cast<std::size_t>(experiment.samples()));
      for (int t = 0; t < experiment.samples(); ++t) {
        const bool spoiled =
            additive ? distribution.found[b](lane, t) > 0
                     : std::abs(residuals.standardised[b](lane, t)) > kLarge * deviation;
        valid[static_cast<std::size_t>(t)] = experiment.isValid(t) && !spoiled;
      }
      experiment.valid = std::move(valid);
    }
  }
  return experiments;
}

}  // namespace uncertainty_identification
