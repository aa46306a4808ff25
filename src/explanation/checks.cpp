#include "explanation/checks.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <sstream>

#include "math/polynomial.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kBins = 10;  // over an experiment

double beyond(double sum, double degrees) {
  if (!std::isfinite(sum) || degrees < 1) return 1;
  return cdf(complement(boost::math::chi_squared(degrees), std::max(0.0, sum)));
}

double twoSided(double z) {
  return std::isfinite(z) ? 2 * cdf(complement(boost::math::normal(), std::abs(z))) : 1;
}

Check check(const std::string& name, double statistic, double p_value, const std::string& where) {
  const bool passed = !(p_value < kCheckThreshold);
  return {name, statistic, p_value, passed, passed ? "" : where};
}

/// Sums over all experiments of signals that are 0 where nothing was measured.
double total(const std::vector<Signals>& signals) {
  double sum = 0;
  for (const Signals& signal : signals) sum += signal.sum();
  return sum;
}

std::vector<Signals> weights(const FitData& data) {
  std::vector<Signals> all;
  for (const Block& block : data.blocks()) all.push_back(block.weight);
  return all;
}

/// Correlations at lags 1..lags, each with standard deviation 1 for independent values of variance
/// 1.
VectorXd correlations(const std::vector<Signals>& signals, int lags, double samples) {
  VectorXd sums = VectorXd::Zero(lags);
  for (const Signals& signal : signals) {
    for (int k = 1; k <= std::min<int>(lags, static_cast<int>(signal.cols()) - 1); ++k)
      sums[k - 1] +=
          (signal.rightCols(signal.cols() - k) * signal.leftCols(signal.cols() - k)).sum();
  }
  return sums / std::sqrt(samples);
}

/// The residual scaled to variance 1, and its squares less their mean scaled to variance 1, large
/// ones cut.
struct Scaled {
  std::vector<Signals> residual, square;
  double samples, skewness, kurtosis;
};

Scaled scaled(const Residuals& residuals, const FitData& data) {
  constexpr double kLargestSquare = 12;
  Scaled all{residuals.standardised, {}, total(weights(data)), 0, 0};
  double power = 0;
  for (const Signals& signal : all.residual) power += signal.square().sum();
  for (Signals& signal : all.residual) signal *= std::sqrt(all.samples / std::max(power, 1e-300));
  double mean = 0, spread = 0;
  for (const Signals& signal : all.residual) {
    all.square.push_back(signal.square().min(kLargestSquare));
    mean += all.square.back().sum() / all.samples;
    all.skewness += signal.cube().sum() / all.samples;
    all.kurtosis += signal.square().square().sum() / all.samples - 0.0;
  }
  for (std::size_t b = 0; b < all.square.size(); ++b) {
    all.square[b] = (all.square[b] - mean) * data.blocks()[b].weight;
    spread += all.square[b].square().sum() / all.samples;
  }
  for (Signals& signal : all.square) signal /= std::sqrt(std::max(spread, 1e-300));
  all.kurtosis -= 3;
  return all;
}

/// Normalised sums of a signal in bins of relative time.
VectorXd timeBins(const std::vector<Signals>& signals, const FitData& data) {
  VectorXd sums = VectorXd::Zero(kBins), counts = VectorXd::Zero(kBins);
  for (std::size_t b = 0; b < signals.size(); ++b) {
    const Block& block = data.blocks()[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      const int length = block.lengths[static_cast<std::size_t>(lane)];
      for (int t = 0; t < length; ++t) {
        const int bin = t * kBins / length;
        sums[bin] += signals[b](lane, t);
        counts[bin] += block.weight(lane, t);
      }
    }
  }
  return sums.cwiseQuotient(counts.cwiseMax(1).cwiseSqrt());
}

std::string timeRange(Index bin, const FitData& data) {
  const double duration = data.blocks().front().samples * data.experiments().front().sample_time;
  std::ostringstream text;
  text.precision(3);
  text << "from " << duration * static_cast<double>(bin) / kBins << " s to "
       << duration * static_cast<double>(bin + 1) / kBins << " s of each experiment";
  return text.str();
}

/// Generic features of input and simulated output that the residual should know nothing of.
struct Feature {
  std::string name;
  Signals signal;
};

void addShiftsOf(const Signals& u, std::vector<Feature>* all) {
  for (const int lag : {0, 1, 2, 3, 5, 8}) {
    Signals v;
    shift(lag, u, &v);
    const std::string of = " of the input " + std::to_string(lag) + " samples before";
    all->push_back({"the value" + of, v});
    all->push_back({"the square" + of, v.square() - 1});
    all->push_back({"the cube" + of, v.cube()});
    all->push_back({"the size" + of, v.abs()});
  }
}

std::vector<Feature> featuresOf(const Fit& fit, const Block& block, const DataSummary& scales) {
  const Polynomials p = fit.model->nominal().polynomials(
      fit.at.parameters.head(fit.model->nominal().parameterCount()));
  Signals x, before;
  filter(p.b, p.a, p.delay, block.u, &x);
  x /= scales.output_deviation;
  const Signals u = block.u / scales.input_deviation;
  shift(1, u, &before);
  Signals share = Signals::Zero(kLanes, block.samples);
  for (int lane = 0; lane < block.lanes; ++lane)
    share.row(lane) = Eigen::Array<double, 1, Eigen::Dynamic>::LinSpaced(
        block.samples, 0, 1.0 * block.samples / block.lengths[static_cast<std::size_t>(lane)]);
  std::vector<Feature> all;
  addShiftsOf(u, &all);
  all.push_back({"the square of the simulated output", x.square() - 1});
  all.push_back({"the cube of the simulated output", x.cube()});
  all.push_back({"a gain of the output that changes over time", x * share});
  all.push_back({"a gain of the input that changes over time", u * share});
  all.push_back({"a constant", Signals::Ones(kLanes, block.samples)});
  all.push_back({"time", share});
  all.push_back({"the product of output and input", x * before});
  for (const auto& [name, mean] : scales.covariates) {
    Signals value = Signals::Zero(kLanes, block.samples);
    for (int lane = 0; lane < block.lanes; ++lane) {
      const Experiment& experiment = *block.experiments[static_cast<std::size_t>(lane)];
      const auto signal = experiment.signals.find(name);
      if (signal == experiment.signals.end()) continue;
      value.row(lane).head(signal->second.size()) = signal->second.transpose().array() - mean;
    }
    all.push_back({name, value});
    all.push_back({"the product of " + name + " and the output", x * value});
  }
  return all;
}

/// A score test: does any combination of whitened features explain some of the residual?
Check featureCheck(const Fit& fit, const FitData& data, const Scaled& of) {
  const DataSummary scales = summarise(data.experiments());
  const Polynomials p = fit.model->nominal().polynomials(
      fit.at.parameters.head(fit.model->nominal().parameterCount()));
  MatrixXd gram;
  VectorXd cross;
  std::vector<std::string> names;
  for (std::size_t b = 0; b < data.blocks().size(); ++b) {
    std::vector<Feature> features = featuresOf(fit, data.blocks()[b], scales);
    std::vector<Signals> whitened(features.size());
    std::vector<const Signals*> list;
    names.clear();
    for (std::size_t i = 0; i < features.size(); ++i) {
      filter(withLeadingOne(p.d), p.c, 0, features[i].signal, &whitened[i]);
      whitened[i] *= data.blocks()[b].weight;
      list.push_back(&whitened[i]);
      names.push_back(features[i].name);
    }
    list.push_back(&of.residual[b]);
    const auto size = static_cast<Index>(features.size());
    if (gram.size() == 0) gram = MatrixXd::Zero(size, size), cross = VectorXd::Zero(size);
    const std::vector<Lanes> products = innerProducts(list, list);
    for (Index i = 0; i < size; ++i) {
      for (Index j = 0; j < size; ++j)
        gram(i, j) += products[static_cast<std::size_t>(i * (size + 1) + j)].sum();
      cross[i] += products[static_cast<std::size_t>(i * (size + 1) + size)].sum();
    }
  }
  const VectorXd scale = gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd unit = scale.asDiagonal() * gram * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(unit);
  const VectorXd single = scale.cwiseProduct(cross);
  const VectorXd along = eigen.eigenvectors().transpose() * single;
  double sum = 0, rank = 0;
  for (Index k = 0; k < along.size(); ++k) {
    if (eigen.eigenvalues()[k] < 1e-6 * eigen.eigenvalues().maxCoeff()) continue;
    sum += along[k] * along[k] / eigen.eigenvalues()[k];
    ++rank;
  }
  Index strongest = 0;
  single.cwiseAbs().maxCoeff(&strongest);
  return check("dependence on the input", sum, beyond(sum, rank),
               "strongest with " + names[static_cast<std::size_t>(strongest)]);
}

/// The band in which the residual's correlations put most power beyond a white one.
std::string frequencyBand(const VectorXd& correlation, double samples, double sample_time) {
  constexpr int kPoints = 50;
  double largest = 0;
  int at = 0;
  for (int i = 1; i < kPoints; ++i) {
    double power = 0;
    for (Index k = 0; k < correlation.size(); ++k)
      power += 2 * correlation[k] / std::sqrt(samples) *
               std::cos(M_PI * i / kPoints * static_cast<double>(k + 1));
    if (std::abs(power) > std::abs(largest)) largest = power, at = i;
  }
  std::ostringstream text;
  text.precision(3);
  text << (largest > 0 ? "too much" : "too little") << " power around "
       << M_PI * at / kPoints / sample_time << " rad/s";
  return text.str();
}

/// Whether some experiments hold more than their share of what is left.
Check experimentCheck(const Scaled& of, const FitData& data) {
  double sum = 0, largest = 0;
  std::string worst;
  for (std::size_t b = 0; b < of.square.size(); ++b) {
    const Block& block = data.blocks()[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      const double z =
          of.square[b].row(lane).sum() / std::sqrt(std::max(1.0, block.weight.row(lane).sum()));
      sum += z * z;
      if (std::abs(z) <= largest) continue;
      largest = std::abs(z);
      worst = block.experiments[static_cast<std::size_t>(lane)]->id;
    }
  }
  return check("variance over experiments", sum, beyond(sum, std::max(1, data.count() - 1)),
               "strongest in " + worst);
}

}  // namespace

std::vector<Check> checksOf(const Fit& fit, const FitData& data, bool heavy_tails) {
  constexpr int kLags = 12, kSquareLags = 5;
  const Scaled of = scaled(residualsOf(fit, data), data);
  const double sample_time = data.experiments().front().sample_time;
  std::vector<Check> checks;
  const VectorXd white = correlations(of.residual, kLags, of.samples);
  checks.push_back(check("whiteness", white.squaredNorm(), beyond(white.squaredNorm(), kLags),
                         frequencyBand(white, of.samples, sample_time)));
  checks.push_back(featureCheck(fit, data, of));
  const VectorXd bins = timeBins(of.square, data);
  Index bin = 0;
  bins.cwiseAbs().maxCoeff(&bin);
  checks.push_back(check("variance over time", bins.squaredNorm(),
                         beyond(bins.squaredNorm(), kBins - 1), timeRange(bin, data)));
  if (heavy_tails) return checks;
  const VectorXd squares = correlations(of.square, kSquareLags, of.samples);
  checks.push_back(check("volatility", squares.squaredNorm(),
                         beyond(squares.squaredNorm(), kSquareLags), "large residuals cluster"));
  const double tails = of.kurtosis / std::sqrt(24 / of.samples);
  checks.push_back(check("tails", of.kurtosis, twoSided(tails),
                         tails > 0 ? "too many large residuals" : "too few large residuals"));
  const double skew = of.skewness / std::sqrt(15 / of.samples);
  checks.push_back(
      check("symmetry", of.skewness, twoSided(skew),
            skew > 0 ? "large residuals are positive" : "large residuals are negative"));
  checks.push_back(experimentCheck(of, data));
  return checks;
}

bool allPassed(const std::vector<Check>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.passed; });
}

double feedbackProbability(const Residuals& residuals, const FitData& data) {
  constexpr int kLags = 4, kOrder = 15;
  MatrixXd gram = MatrixXd::Zero(kOrder + 1, kOrder + 1);
  const auto each = [&](const auto& use) {
    for (std::size_t b = 0; b < data.blocks().size(); ++b) {
      const Block& block = data.blocks()[b];
      for (int lane = 0; lane < block.lanes; ++lane)
        use(block.u.row(lane).head(block.lengths[static_cast<std::size_t>(lane)]).matrix(),
            residuals.standardised[b].row(lane).matrix());
    }
  };
  const auto past = [](const auto& u, Index t) {
    VectorXd values(kOrder + 1);
    for (Index k = 0; k <= kOrder; ++k) values[k] = u[t - k];
    return values;
  };
  double power = 0, samples = 0;
  each([&](const auto& u, const auto& /*w*/) {
    for (Index t = kOrder; t < u.size(); ++t) {
      gram += past(u, t) * past(u, t).transpose();
      power += u[t] * u[t];
      ++samples;
    }
  });
  if (samples < 10 * kOrder) return 1;
  MatrixXd inner = gram.bottomRightCorner(kOrder, kOrder);
  inner.diagonal() *= 1 + 1e-9;
  inner.diagonal().array() += 1e-12 * power;
  VectorXd predictor(kOrder + 1);
  predictor << 1, -inner.ldlt().solve(gram.bottomLeftCorner(kOrder, 1));
  if (predictor.dot(gram * predictor) < 1e-6 * power) return 1;  // wholly predictable
  VectorXd products = VectorXd::Zero(kLags), squares = VectorXd::Zero(kLags);
  each([&](const auto& u, const auto& w) {
    for (Index t = kOrder; t < u.size(); ++t) {
      const double innovation = predictor.dot(past(u, t));
      for (Index k = 1; k <= kLags && t - k >= kOrder; ++k) {
        products[k - 1] += w[t - k] * innovation;
        squares[k - 1] += std::pow(w[t - k] * innovation, 2);
      }
    }
  });
  const double sum = (products.array().square() / squares.array().max(1e-300)).sum();
  return beyond(sum, kLags);
}

}  // namespace uncertainty_identification
