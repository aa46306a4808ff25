#include "support/core_setup.h"

#include <algorithm>
#include <cmath>

#include "model/sensitivity_model.h"

namespace uncertainty_identification::test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

std::unique_ptr<LinearModel> modelOf(const Configuration& configuration, double sample_time) {
  auto nominal = makeNominalModel(configuration.nominal_model, sample_time);
  ErrorModelOptions error_model = configuration.error_model;
  completeErrorModel(*nominal, &error_model);
  return makeLinearModel(nominal, error_model, configuration.estimation);
}

}  // namespace

CoreSetup::CoreSetup(const Configuration& configuration, std::vector<Experiment> experiments,
                     int threads)
    : experiments_(std::move(experiments)),
      blocks_(makeBlocks(experiments_)),
      model_(modelOf(configuration, experiments_.front().sample_time)),
      likelihood_(std::make_unique<Likelihood>(*model_, blocks_,
                                               static_cast<int>(experiments_.size()), threads)) {}

Expectation CoreSetup::expect(const ModelParameters& at) const {
  return likelihood_->expect(likelihood_->statistics(at.parameters, false), at);
}

Configuration atRest(int nb, int na, int nc, int nd, int delay) {
  Configuration configuration;
  NominalModelOptions& nominal = configuration.nominal_model;
  nominal.structure = Structure::box_jenkins;
  nominal.nb = nb;
  nominal.na = na;
  nominal.nc = nc;
  nominal.nd = nd;
  nominal.delay = delay;
  nominal.orders_auto = false;
  configuration.error_model = paperErrorModel();
  configuration.estimation.initial_state = InitialState::zero;
  configuration.estimation.noise_start = NoiseStart::zero;
  configuration.estimation.offsets = Offsets::none;
  configuration.estimation.threads = 1;
  return configuration;
}

Configuration configurationOf(const RandomSystemOptions& options) {
  Configuration configuration =
      atRest(options.nb, options.na, options.nc, options.nd, options.delay);
  ErrorModelOptions& error = configuration.error_model;
  error.taps = options.taps;
  error.components = options.taps == 0 ? 1 : options.components;
  error.constraint = options.zero_static_gain ? Constraint::zero_static_gain : Constraint::free;
  error.basis = options.laguerre_pole == 0 ? BasisKind::fir : BasisKind::laguerre;
  error.pole = options.laguerre_pole;
  return configuration;
}

Configuration configurationOf(const Golden& golden) {
  Configuration configuration = atRest(golden.nb, golden.na, golden.nc, golden.nd, golden.delay);
  ErrorModelOptions& error = configuration.error_model;
  error.taps = static_cast<int>(golden.T.rows());
  error.constraint = Constraint::explicit_matrix;
  error.T = golden.T;
  error.components = golden.start.mixture.components();
  return configuration;
}

ModelParameters parametersOf(const dense::Model& model) {
  ModelParameters at;
  at.parameters.resize(model.b.size() + model.a.size() + model.c.size() + model.d.size());
  at.parameters << model.b, model.a, model.c, model.d;
  at.mixture = model.mixture;
  if (at.mixture.components() == 0) at.mixture = {{1.0}, {VectorXd(0)}, {MatrixXd(0, 0)}};
  at.noise_variance = model.noise_variance;
  return at;
}

ModelParameters parametersOf(const GoldenPoint& point) {
  return {point.theta, point.mixture, point.noise_variance};
}

VectorXd appended(const VectorXd& parameters, double value) {
  VectorXd longer(parameters.size() + 1);
  longer << parameters, value;
  return longer;
}

OptimisationOptions optimisationOptions(const Configuration& configuration, const Mixture& start,
                                        double tolerance) {
  OptimisationOptions options;
  options.constraint = configuration.error_model.constraint;
  options.tolerance = tolerance;
  options.floor = covarianceFloor(start);
  return options;
}

MatrixXd differences(const VectorFunction& function, const VectorXd& at, double relative_step) {
  MatrixXd jacobian(function(at).size(), at.size());
  for (Index j = 0; j < at.size(); ++j) {
    const auto slope = [&](double step) -> VectorXd {
      VectorXd high = at, low = at;
      high[j] += step;
      low[j] -= step;
      return (function(high) - function(low)) / (high[j] - low[j]);
    };
    const double step = relative_step * std::max(std::abs(at[j]), 0.1);
    jacobian.col(j) = (4 * slope(step / 2) - slope(step)) / 3;
  }
  return jacobian;
}

VectorXd naturalCoordinates(const ModelParameters& at) {
  std::vector<double> all(at.parameters.data(), at.parameters.data() + at.parameters.size());
  all.insert(all.end(), at.mixture.weights.begin(), at.mixture.weights.end());
  for (const VectorXd& mean : at.mixture.means) {
    all.insert(all.end(), mean.data(), mean.data() + mean.size());
  }
  for (const MatrixXd& covariance : at.mixture.covariances) {
    for (Index row = 0; row < covariance.rows(); ++row) {
      for (Index col = 0; col <= row; ++col) all.push_back(covariance(row, col));
    }
  }
  all.push_back(std::log(at.noise_variance));
  return Eigen::Map<VectorXd>(all.data(), static_cast<Index>(all.size()));
}

ModelParameters fromNaturalCoordinates(const VectorXd& coordinates, const ModelParameters& sizes) {
  ModelParameters at = sizes;
  Index next = at.parameters.size();
  at.parameters = coordinates.head(next);
  for (double& weight : at.mixture.weights) weight = coordinates[next++];
  for (VectorXd& mean : at.mixture.means) {
    mean = coordinates.segment(next, mean.size()).eval();
    next += mean.size();
  }
  for (MatrixXd& covariance : at.mixture.covariances) {
    for (Index row = 0; row < covariance.rows(); ++row) {
      for (Index col = 0; col <= row; ++col) {
        covariance(row, col) = covariance(col, row) = coordinates[next++];
      }
    }
  }
  at.noise_variance = std::exp(coordinates[next]);
  return at;
}

RandomSystem example1(std::uint64_t seed, int experiments) {
  RandomSystemOptions options;
  options.experiments = experiments;
  options.min_samples = options.max_samples = 100;
  options.input_deviation = std::sqrt(10.0);
  dense::Model truth = randomSystem(options, 1).truth;
  truth.b = vectorOf({1.0});
  truth.a = vectorOf({0.5});
  truth.c = vectorOf({0.1});
  truth.d = vectorOf({0.8});
  truth.noise_variance = 0.1;
  truth.mixture = {{0.5, 0.5},
                   {vectorOf({-1.0}), vectorOf({1.0})},
                   {MatrixXd::Constant(1, 1, 0.2), MatrixXd::Constant(1, 1, 0.2)}};
  return simulateSystem(truth, options, seed);
}

Configuration example1Configuration() {
  Configuration configuration = atRest(1, 1, 1, 1, 1);
  configuration.error_model.taps = 2;
  configuration.error_model.components = 2;
  return configuration;
}

VectorXd vectorOf(std::initializer_list<double> values) {
  return Eigen::Map<const VectorXd>(values.begin(), static_cast<Index>(values.size()));
}

std::vector<const Experiment*> pointersTo(const std::vector<Experiment>& experiments) {
  std::vector<const Experiment*> all;
  for (const Experiment& experiment : experiments) all.push_back(&experiment);
  return all;
}

}  // namespace uncertainty_identification::test
