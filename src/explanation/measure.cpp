#include "explanation/measure.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "estimation/simulation_fit.h"
#include "explanation/bode_area.h"
#include "math/distributions.h"
#include "math/polynomial.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Mean and standard deviation of one experiment's simulated output under each component of the
/// mixture; the simulation starts from rest.
struct Prediction {
  std::vector<double> weights;
  std::vector<ArrayXd> means, deviations;
};

/// Variance of the noise H omega at each sample, relative to the variance sigma^2 of omega.
ArrayXd noisePower(const Fit& fit, Index samples) {
  const Polynomials p = fit.model->nominal().polynomials(
      fit.at.parameters.head(fit.model->nominal().parameterCount()));
  Signals impulse = Signals::Zero(kLanes, std::max<Index>(samples, 200)), response;
  impulse.col(0).setOnes();
  filter(withLeadingOne(p.c), p.d, 0, impulse, &response);
  return ArrayXd::Constant(samples, response.row(0).square().sum());
}

Prediction predicted(const Fit& fit, const Chain& chain, int lane, const MatrixXd& about,
                     const ArrayXd& noise) {
  const Index samples = chain.block.lengths[static_cast<std::size_t>(lane)];
  const Index n = about.rows();
  const ArrayXd base = chain.x.row(lane).head(samples).transpose();
  MatrixXd X(samples, n);
  for (Index i = 0; i < n; ++i)
    X.col(i) = chain.X[static_cast<std::size_t>(i)].row(lane).head(samples).transpose().matrix();
  ArrayXd own = noise;
  if (chain.deviation.size() > 0)
    own *= chain.deviation.row(lane).head(samples).transpose().square();
  for (const RandomSignal& random : chain.random)
    own += random.variance * random.z.row(lane).head(samples).transpose().square();
  own *= fit.at.noise_variance;
  Prediction all;
  if (n == 0) return {{1.0}, {base}, {own.sqrt()}};
  all.weights = fit.at.mixture.weights;
  for (std::size_t i = 0; i < all.weights.size(); ++i) {
    all.means.push_back(base + (X * fit.at.mixture.means[i]).array());
    const MatrixXd spread = X * fit.at.mixture.covariances[i];
    all.deviations.push_back((own + spread.cwiseProduct(X).rowwise().sum().array()).sqrt());
  }
  return all;
}

/// Adds the response to the initial state and offset that the first samples determine, as the
/// simulation fit does.
void startFromMeasured(const MatrixXd& unknown, const Block& block, int lane,
                       Prediction* prediction) {
  if (unknown.cols() == 0) return;
  const Index length = unknown.rows();
  ArrayXd mean = ArrayXd::Zero(length);
  for (std::size_t i = 0; i < prediction->weights.size(); ++i)
    mean += prediction->weights[i] * prediction->means[i];
  const VectorXd measured = block.weight.row(lane).head(length).transpose();
  const VectorXd missing = block.y.row(lane).head(length).transpose() - mean;
  const ArrayXd added = unknown * initialCoefficients(measured.asDiagonal() * unknown,
                                                      measured.cwiseProduct(missing));
  for (ArrayXd& of_component : prediction->means) of_component += added;
}

/// Distribution function of the standard normal distribution.
double normal(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

MatrixXd meanErrors(const Fit& fit, int count) {
  if (fit.at.mixture.components() == 0) return MatrixXd::Zero(0, count);
  return fit.at.mixture.mean().replicate(1, count);
}

}  // namespace

VectorXd logDensities(const Fit& fit, const FitData& data) {
  const Fit there = evaluateOn(fit, data);
  return there.of_experiments.size() == data.count() ? there.of_experiments
                                                     : VectorXd::Constant(data.count(), -1e300);
}

HeldOut heldOut(const Fit& fit, const FitData& data) {
  HeldOut measured;
  measured.log_density = logDensities(fit, data);
  measured.noise_variance = fit.at.noise_variance;
  measured.bode_area = bodeArea(fit);
  const auto model = fit.model->forExperiments(data.count());
  const MatrixXd about = meanErrors(fit, data.count());
  double wrong = 0, sum = 0, squares = 0, count = 0, inside50 = 0, inside90 = 0, inside95 = 0;
  for (const Block& block : data.blocks()) {
    const Chain chain = model->simulated(block, fit.at.parameters, about);
    const ArrayXd noise = noisePower(fit, block.samples);
    const MatrixXd unknown = model->unknownSignals(fit.at.parameters, block.samples);
    for (int lane = 0; lane < block.lanes; ++lane) {
      const int length = block.lengths[static_cast<std::size_t>(lane)];
      Prediction prediction = predicted(fit, chain, lane, about, noise.head(length));
      startFromMeasured(unknown.topRows(length), block, lane, &prediction);
      for (int t = 0; t < length; ++t) {
        if (block.weight(lane, t) == 0) continue;
        const double y = block.y(lane, t);
        double mean = 0, below = 0;
        for (std::size_t i = 0; i < prediction.weights.size(); ++i) {
          mean += prediction.weights[i] * prediction.means[i][t];
          below += prediction.weights[i] *
                   normal((y - prediction.means[i][t]) / prediction.deviations[i][t]);
        }
        const double level = std::abs(2 * below - 1);
        inside50 += level <= 0.5;
        inside90 += level <= 0.9;
        inside95 += level <= 0.95;
        wrong += (y - mean) * (y - mean);
        sum += y;
        squares += y * y;
        ++count;
      }
    }
  }
  count = std::max(count, 1.0);
  const double spread = squares - sum * sum / count;
  measured.nrmse_fit_percent = 100 * (1 - std::sqrt(wrong / std::max(spread, 1e-300)));
  measured.coverage_50 = inside50 / count;
  measured.coverage_90 = inside90 / count;
  measured.coverage_95 = inside95 / count;
  return measured;
}

double spreadOfLevels(const std::vector<Experiment>& experiments) {
  double all = 0, sum = 0, count = 0, own = 0;
  for (const Experiment& experiment : experiments) {
    double of_squares = 0, of_sum = 0, of_count = 0;
    for (int k = 0; k < experiment.samples(); ++k) {
      if (!experiment.isValid(k)) continue;
      of_squares += experiment.y[k] * experiment.y[k];
      of_sum += experiment.y[k];
      of_count += 1;
    }
    all += of_squares;
    sum += of_sum;
    count += of_count;
    own += of_squares - of_sum * of_sum / std::max(of_count, 1.0);
  }
  return std::sqrt((all - sum * sum / std::max(count, 1.0)) / std::max(own, 1e-300));
}

MeanGain meanGain(const PairedGains& gains) {
  const auto squares = [](const VectorXd& values) {
    return values.size() > 0 ? (values.array() - values.mean()).square().sum() : 0.0;
  };
  const auto count = static_cast<double>(gains.held.size());
  const double freedom = count - 1 + std::max(0.0, static_cast<double>(gains.training.size()) - 1);
  MeanGain mean{gains.held.mean(), std::nan(""), std::nan(""), std::nan("")};
  if (freedom < 1) return mean;
  mean.standard_error =
      std::sqrt((squares(gains.held) + squares(gains.training)) / freedom / count);
  const double half = studentQuantile(0.95, freedom) * mean.standard_error;
  mean.lower_90 = mean.value - half;
  mean.upper_90 = mean.value + half;
  return mean;
}

Gain gainOf(const HeldOut& before, const HeldOut& after, const PairedGains& gains) {
  Gain gain;
  const MeanGain mean = meanGain(gains);
  gain.log_density = mean.value;
  gain.standard_error = mean.standard_error;
  gain.lower_90 = mean.lower_90;
  gain.upper_90 = mean.upper_90;
  gain.nrmse_fit_percent = {before.nrmse_fit_percent, after.nrmse_fit_percent};
  gain.coverage_50 = {before.coverage_50, after.coverage_50};
  gain.coverage_90 = {before.coverage_90, after.coverage_90};
  gain.coverage_95 = {before.coverage_95, after.coverage_95};
  gain.noise_variance = {before.noise_variance, after.noise_variance};
  gain.bode_area = {before.bode_area, after.bode_area};
  return gain;
}

namespace {

/// The output of experiment r simulated with its own error parameters, and the standard deviation
/// of its noise.
void draw(const Fit& fit, const FitData& data, int r, VectorXd* simulated, VectorXd* deviation) {
  const Fit there = evaluateOn(fit, data);
  if (!std::isfinite(there.log_likelihood)) return;
  const Residuals residuals = residualsOf(there, data);
  for (const Block& block : data.blocks()) {
    for (int lane = 0; lane < block.lanes; ++lane) {
      if (block.index[static_cast<std::size_t>(lane)] != r) continue;
      const Index length = block.lengths[static_cast<std::size_t>(lane)];
      const Chain chain = there.model->simulated(block, fit.at.parameters, there.xi);
      *simulated = chain.expected().row(lane).head(length).transpose().matrix();
      const auto offset = residuals.coefficients.rows() - static_cast<Index>(chain.random.size());
      for (std::size_t k = 0; k < chain.random.size(); ++k)
        *simulated += (residuals.coefficients(offset + static_cast<Index>(k), r) -
                       chain.random[k].about[lane]) *
                      chain.random[k].z.row(lane).head(length).transpose().matrix();
      ArrayXd power = noisePower(fit, length) * fit.at.noise_variance;
      if (chain.deviation.size() > 0)
        power *= chain.deviation.row(lane).head(length).transpose().square();
      *deviation = power.sqrt().matrix();
    }
  }
}

}  // namespace

std::vector<ExperimentPicture> picturesOf(const Fit& before, const Fit& after,
                                          const FitData& data) {
  const Fit there = evaluateOn(before, data);
  if (there.of_experiments.size() != data.count()) return {};
  std::vector<int> order(static_cast<std::size_t>(data.count()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int left, int right) {
    return there.of_experiments[left] /
               data.experiments()[static_cast<std::size_t>(left)].samples() <
           there.of_experiments[right] /
               data.experiments()[static_cast<std::size_t>(right)].samples();
  });
  std::vector<int> chosen{order.front()};
  if (order.size() > 1) chosen.push_back(order[order.size() / 2]);
  std::vector<ExperimentPicture> pictures;
  for (const int r : chosen) {
    const Experiment& experiment = data.experiments()[static_cast<std::size_t>(r)];
    ExperimentPicture picture;
    picture.id = experiment.id;
    picture.sample_time = experiment.sample_time;
    picture.input = experiment.u;
    picture.measured = experiment.y;
    draw(before, data, r, &picture.simulated_before, &picture.deviation_before);
    draw(after, data, r, &picture.simulated_after, &picture.deviation_after);
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

}  // namespace uncertainty_identification
