#include "explanation/fit.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "estimation/scoring.h"
#include "explanation/clock.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Fit failed(std::shared_ptr<const ExtendedModel> model, const ModelParameters& at) {
  return {std::move(model), at, -std::numeric_limits<double>::infinity(), {}, {}};
}

Fit described(std::shared_ptr<const ExtendedModel> model, const ModelParameters& at,
              const Expectation& expectation) {
  const double total = expectation.total();
  if (!std::isfinite(total)) return failed(std::move(model), at);
  return {std::move(model), at, total, expectation.log_likelihood,
          latentMoments(expectation).means};
}

}  // namespace

FitData::FitData(std::vector<Experiment> experiments)
    : experiments_(std::make_shared<const std::vector<Experiment>>(std::move(experiments))),
      blocks_(makeBlocks(*experiments_)) {}

double FitData::samples() const {
  double sum = 0;
  for (const Experiment& experiment : *experiments_) sum += experiment.validSamples();
  return sum;
}

Fit evaluated(std::shared_ptr<const ExtendedModel> model, const ModelParameters& at,
              const FitData& data) {
  if (!model->admissible(at.parameters)) return failed(std::move(model), at);
  const Likelihood likelihood(*model, data.blocks(), data.count(), 1);
  const Statistics statistics = likelihood.statistics(at.parameters, false);
  return described(model, at, likelihood.expect(statistics, at));
}

Fit mixtureFitted(std::shared_ptr<const ExtendedModel> model, const ModelParameters& at,
                  const FitData& data, const OptimisationOptions& options, int iterations) {
  if (!model->admissible(at.parameters)) return failed(std::move(model), at);
  constexpr double kTolerance = 1e-2;
  const Likelihood likelihood(*model, data.blocks(), data.count(), 1);
  const Statistics statistics = likelihood.statistics(at.parameters, false);
  ModelParameters fitted = at;
  const double value = fitMixture(likelihood, statistics, options, iterations, kTolerance, &fitted);
  if (!std::isfinite(value)) return failed(std::move(model), at);
  return described(model, fitted, likelihood.expect(statistics, fitted));
}

Residuals residualsOf(const Fit& fit, const FitData& data) {
  Residuals residuals;
  const double scale = 1 / std::sqrt(fit.at.noise_variance);
  for (const Block& block : data.blocks()) {
    Response response;
    fit.model->evaluate(block, fit.at.parameters, false, &response);
    Signals left = response.value.residual;
    if (residuals.coefficients.size() == 0)
      residuals.coefficients = MatrixXd::Zero(response.column_precision.size(), data.count());
    for (int lane = 0; lane < block.lanes; ++lane) {
      const int r = block.index[static_cast<std::size_t>(lane)];
      for (Index i = 0; i < fit.xi.rows(); ++i)
        left.row(lane) -=
            fit.xi(i, r) * response.value.regressors[static_cast<std::size_t>(i)].row(lane);
      const VectorXd zeta = ExtendedModel::columnCoefficients(response, left, lane);
      residuals.coefficients.col(r) = zeta;
      for (Index k = 0; k < zeta.size(); ++k) {
        const Signals& column = *response.value.columns[static_cast<std::size_t>(k)];
        left.row(lane).head(column.cols()) -= zeta[k] * column.row(lane);
      }
    }
    left *= scale * block.weight;
    residuals.standardised.push_back(std::move(left));
  }
  return residuals;
}

Fit relinearised(const Fit& fit, const FitData& data) {
  if (!fit.model->isLocallyLinear() || !std::isfinite(fit.log_likelihood)) return fit;
  return evaluated(fit.model->about(fit.model->pointsOf(data.blocks(), fit.at.parameters, fit.xi)),
                   fit.at, data);
}

Fit takeScoringSteps(Fit fit, const FitData& data, const OptimisationOptions& options, int steps,
                     double tolerance) {
  constexpr int kLinearisations = 3;  // until the posterior means hardly change
  const bool local = fit.model->isLocallyLinear();
  for (int round = 0; local && round < kLinearisations && std::isfinite(fit.log_likelihood);
       ++round)
    fit = relinearised(fit, data);
  const int at_once = local ? 2 : steps;
  for (int done = 0; done < steps && std::isfinite(fit.log_likelihood); done += at_once) {
    const Likelihood likelihood(*fit.model, data.blocks(), data.count(), 1);
    const ModelParameters at = scoringSteps(likelihood, fit.at, options, at_once, tolerance);
    Fit next = relinearised(evaluated(fit.model, at, data), data);
    const double gain = next.log_likelihood - fit.log_likelihood;
    if (gain > 0) fit = std::move(next);
    if (gain < tolerance) break;
  }
  return fit;
}

Fit evaluateOn(const Fit& fit, const FitData& data) {
  constexpr int kRounds = 4;
  ModelParameters at = fit.at;
  std::shared_ptr<const ExtendedModel> model = fit.model->forExperiments(data.count());
  if (!model->isLocallyLinear()) return evaluated(model, at, data);
  MatrixXd points = at.mixture.mean().replicate(1, data.count());
  if (at.mixture.components() == 0) points = MatrixXd::Zero(0, data.count());
  model = model->about(points);
  if (hasClock(*model)) model = model->about(clockStart(*model, at, data));
  Fit fitted = evaluated(model, at, data);
  for (int round = 0; round < kRounds && std::isfinite(fitted.log_likelihood); ++round)
    fitted = relinearised(fitted, data);
  return fitted;
}

}  // namespace uncertainty_identification
