#include "configuration/thread_count.h"
#include "data/experiment_checks.h"
#include "estimation/linearisation.h"
#include "estimation/selection.h"
#include "identification/mean_plant.h"
#include "identification/odd_experiments.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"
#include "math/information_criterion.h"
#include "residual_tests/residual_tests.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

std::vector<ExperimentEstimate> describeExperiments(const Problem& problem,
                                                    const FittedModel& fitted) {
  const ModelParameters& point = fitted.optimum.point;
  const Expectation e =
      fitted.likelihood->expect(fitted.likelihood->statistics(point.parameters, false), point);
  const LatentMoments moments = latentMoments(e);
  std::vector<ExperimentEstimate> described;
  for (Eigen::Index r = 0; r < e.log_likelihood.size(); ++r) {
    const Experiment& experiment = problem.data.experiments[static_cast<std::size_t>(r)];
    const VectorXd responsibilities = e.responsibilities.col(r);
    described.push_back(
        {experiment.id,
         experiment.validSamples(),
         {responsibilities.data(), responsibilities.data() + responsibilities.size()},
         moments.means.col(r),
         e.log_likelihood[r]});
  }
  return described;
}

/// Tests of the residuals of the whole model: a plant that was fitted to its simulation was
/// estimated from these data too.
ResidualTests testsOf(const Problem& problem, const FittedModel& fitted, Journal* journal) {
  const ModelParameters& point = fitted.optimum.point;
  const std::vector<Block>& blocks = problem.data.blocks;
  const NominalModel& fitted_nominal = fitted.model->nominal();
  const Polynomials nominal =
      fitted_nominal.polynomials(point.parameters.head(fitted_nominal.parameterCount()));
  if (!problem.plant) return residualTests(*fitted.model, blocks, point.parameters, &nominal);
  Problem whole = problem;
  whole.plant.reset();
  whole.nominal_model = {};  // the plant is the configuration's
  const std::unique_ptr<LinearModel> model = buildModel(whole);
  ModelParameters at = point;
  at.parameters.resize(model->parameterCount());
  const Eigen::Index of_plant = at.parameters.size() - point.parameters.size();
  at.parameters << problem.plant->point.parameters.head(of_plant), point.parameters;
  const auto about = linearisedAtPosteriorMeans(
      *model, blocks, problem.data.count(), threadCount(problem.configuration.estimation.threads),
      at, &journal->passes);
  return residualTests(about ? *about->model : *model, blocks, at.parameters, &nominal);
}

void tellOdd(const std::string& odd, Journal* journal, Estimate* estimate) {
  if (odd.empty()) return;
  journal->warnings.push_back(odd);
  estimate->has_odd_experiments = true;
  estimate->variation += " Not all experiments belong together, as a warning tells.";
}

}  // namespace

Estimate describe(const Problem& problem, const FittedModel& fitted, Journal* journal) {
  const LinearModel& model = *fitted.model;
  const Optimum& optimum = fitted.optimum;
  const ModelParameters& point = optimum.point;
  const NominalModel& nominal = model.nominal();
  const Polynomials p = nominal.polynomials(point.parameters.head(nominal.parameterCount()));
  Estimate estimate;
  estimate.configuration = problem.configuration;
  estimate.configuration.error_model.components = fitted.components;
  estimate.data_fingerprint = dataFingerprint(problem.data.experiments);
  estimate.experiment_count = problem.data.count();
  estimate.sample_count = problem.data.validSamples();
  estimate.rejected = problem.data.rejected;
  estimate.nominal_model = {
      nominal.structure(), problem.data.sampleTime(), p.delay, p.b, p.a, p.c, p.d, {}, {}};
  estimate.error_model.options = estimate.configuration.error_model;
  estimate.error_model.T = model.basis().T();
  estimate.error_model.mixture = point.mixture;
  estimate.experiments = describeExperiments(problem, fitted);
  describeParameters(problem, fitted, journal, &estimate);
  if (problem.plant) {
    const OffsetSide side = estimate.configuration.estimation.offset_side;
    (side == OffsetSide::input ? estimate.offset_u : estimate.offset_y) = problem.plant->offset;
  }
  estimate.residual_tests = testsOf(problem, fitted, journal);
  estimate.log_likelihood = optimum.log_likelihood;
  estimate.termination = optimum.termination;
  estimate.message = optimum.message;
  estimate.iterations = optimum.iterations;
  estimate.trace = optimum.trace;
  const std::size_t fixed = problem.plant ? problem.plant->parameters.size() : 0;
  estimate.bic =
      bic(estimate.log_likelihood, model.parameterCount() + static_cast<int>(fixed) + 1,
          mixtureParameters(problem.configuration, model.regressors(), point.mixture.components()),
          static_cast<double>(estimate.sample_count), estimate.experiment_count);
  estimate.variation = variationText(estimate, model);
  const EstimationOptions& options = problem.configuration.estimation;
  const double offset = offsetOf(problem, model, point);
  const std::vector<Experiment>& experiments = problem.data.experiments;
  estimate.simulation_fit_percent =
      meanPlantFit(model, point, offset, options, experiments).pooledFor(options.offsets);
  tellOdd(oddExperiments(model, point, offset, options, experiments), journal, &estimate);
  estimate.trust = trustOf(fitted, estimate);
  journal->passes += fitted.likelihood->passes();
  return estimate;
}

}  // namespace uncertainty_identification
