#include "explanation/estimate_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

TEST(EstimateOf, NeedsNoMoreIterationsThanAllowed) {
  const std::vector<Experiment> experiments = test::example1(2, 20).experiments;
  Configuration configuration = test::example1Configuration();
  configuration.bounds.frequencies = 0;
  const Estimate base = Identifier(configuration).identify(experiments);
  const FitData data(usedBy(base, experiments));
  Fit fit = fitOf(base, data, summarise(data.experiments()));
  fit.at.parameters[0] *= 1.1;
  fit = evaluated(fit.model, fit.at, data);
  const Estimate hurried = estimateOf(fit, data, base, 1);
  const Estimate unhurried = estimateOf(fit, data, base, 500);
  EXPECT_EQ(hurried.termination, Termination::iteration_limit);
  EXPECT_LT(hurried.iterations, unhurried.iterations);
  EXPECT_NEAR(unhurried.log_likelihood, base.log_likelihood, 0.01);
  EXPECT_EQ(hurried.configuration.estimation.max_iterations,
            configuration.estimation.max_iterations)
      << "the limit is of this optimisation, not of whoever identifies again";
}

TEST(FitOf, HoldsAPlantThatWasFittedToItsSimulation) {
  const std::vector<Experiment> experiments = test::example1(2, 20).experiments;
  Configuration configuration = test::example1Configuration();
  configuration.bounds.frequencies = 0;
  configuration.nominal_model.fit = PlantFit::simulation;
  const Estimate base = Identifier(configuration).identify(experiments);
  const FitData data(usedBy(base, experiments));
  const Fit fit = fitOf(base, data, summarise(data.experiments()));
  EXPECT_EQ(fit.model->nominal().parameterCount(),
            base.nominal_model.c.size() + base.nominal_model.d.size());
  EXPECT_NEAR(fit.log_likelihood, base.log_likelihood, 0.01);
  const Estimate again = estimateOf(fit, data, base, 500);
  EXPECT_TRUE(again.nominal_model.b.isApprox(base.nominal_model.b, 1e-3));
  EXPECT_TRUE(again.nominal_model.a.isApprox(base.nominal_model.a, 1e-3));
  EXPECT_NEAR(again.log_likelihood, base.log_likelihood, 0.1);
}

TEST(FitOf, EvaluatesANoiseModelAtTheEdgeOfStability) {
  const std::vector<Experiment> experiments = test::example1(2, 4).experiments;
  Configuration configuration = test::example1Configuration();
  configuration.nominal_model.structure = Structure::box_jenkins;
  configuration.nominal_model.nc = configuration.nominal_model.nd = 1;
  Estimate estimate = Identifier(configuration).identify(experiments);
  estimate.nominal_model.parameters.clear();
  estimate.nominal_model.d[0] = -1.0000000001;  // beyond it, by rounding
  const FitData data(usedBy(estimate, experiments));
  EXPECT_TRUE(std::isfinite(fitOf(estimate, data, summarise(data.experiments())).log_likelihood));
}

}  // namespace
}  // namespace uncertainty_identification
