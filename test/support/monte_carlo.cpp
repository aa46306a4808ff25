#include "support/monte_carlo.h"

#include <cmath>
#include <numeric>

#include "io/truth_yaml.h"
#include "simulation/simulate.h"
#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/io/configuration_yaml.h"

namespace uncertainty_identification::test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

Truth example1Truth(int experiments, int samples) {
  Truth truth = loadTruth(std::string(PROJECT_FOLDER) + "/config/example1_truth.yaml");
  truth.experiments = experiments;
  truth.samples = {samples};
  return truth;
}

Configuration example1AtRest() {
  Configuration configuration =
      loadConfiguration(std::string(PROJECT_FOLDER) + "/config/example1.yaml");
  configuration.estimation.threads = 1;
  return configuration;
}

ModelParameters example1Parameters() {
  const Truth truth = example1Truth();
  ModelParameters at;
  at.parameters =
      vectorOf({truth.plant.b[0], truth.plant.a[0], truth.noise.c[0], truth.noise.d[0]});
  at.mixture = truth.error_model.mixture;
  at.noise_variance = truth.noise.variance;
  return at;
}

ModelParameters paperStart() {
  ModelParameters at;
  at.parameters = vectorOf({1.251, 0.4523, 0.0772, 0.7546});
  at.mixture = {{0.5, 0.5},
                {VectorXd::Constant(1, -1.1962), VectorXd::Constant(1, 2.9673)},
                {MatrixXd::Constant(1, 1, 0.8651), MatrixXd::Constant(1, 1, 0.8651)}};
  at.noise_variance = 0.0612;
  return at;
}

MonteCarloRun example1Run(std::uint64_t seed) {
  const Configuration configuration = example1AtRest();
  const CoreSetup setup(configuration, simulate(example1Truth(), seed));
  const ModelParameters truth = example1Parameters();
  MonteCarloRun run;
  run.estimate = Identifier(configuration).identify(setup.experiments());
  run.from_truth = maximumLikelihood(setup.likelihood(), truth,
                                     optimisationOptions(configuration, truth.mixture, 1e-7))
                       .log_likelihood;
  return run;
}

double TableParameter::mean() const {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double TableParameter::deviation() const {
  const double centre = mean();
  double sum = 0;
  for (double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

double TableParameter::coverage(const std::vector<double>& standard_errors) const {
  constexpr double kQuantile = 1.959963984540054;  // of the standard normal distribution, at 97.5 %
  double covered = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::abs(values[k] - truth) <= kQuantile * standard_errors[k]) ++covered;
  }
  return covered / static_cast<double>(values.size());
}

std::vector<TableParameter> tableParameters(const std::vector<MonteCarloRun>& runs) {
  const ModelParameters truth = example1Parameters();
  std::vector<TableParameter> table{{"b1", truth.parameters[0], {}, {}, {}},
                                    {"a1", truth.parameters[1], {}, {}, {}},
                                    {"c1", truth.parameters[2], {}, {}, {}},
                                    {"d1", truth.parameters[3], {}, {}, {}},
                                    {"sigma^2", truth.noise_variance, {}, {}, {}}};
  for (const MonteCarloRun& run : runs) {
    std::vector<ParameterEstimate> all = run.estimate.nominal_model.parameters;
    all.push_back(run.estimate.noise_variance);
    for (std::size_t k = 0; k < table.size(); ++k) {
      table[k].values.push_back(all[k].value);
      table[k].errors.push_back(all[k].standard_error);
      table[k].robust_errors.push_back(all[k].robust_standard_error);
    }
  }
  return table;
}

}  // namespace uncertainty_identification::test
