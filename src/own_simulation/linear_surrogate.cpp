#include "own_simulation/linear_surrogate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "curves/plant_orders.h"
#include "curves/preparation.h"
#include "own_simulation/linear_simulation.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr int kMaxOrder = 3, kMostSamples = 6000;

class SurrogateSimulation : public Simulation {
 public:
  SurrogateSimulation(Simulation& own, std::unique_ptr<Simulation> linear)
      : own_(own), linear_(std::move(linear)) {}

  std::string description() const override { return own_.description(); }
  std::vector<SimulationParameter> parameters() const override { return linear_->parameters(); }
  bool canRerun() const override { return true; }

  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    const Eigen::VectorXd y = own_.run(input, ownValuesOf(own_));
    const Eigen::VectorXd at = ownValuesOf(*linear_);
    SimulationInput of_own = input;
    if (!own_.canRerun() && input.measured_u.size() > 0) of_own.u = input.measured_u;
    if (values == at && of_own.u == input.u) return y;
    return y + linear_->run(input, values) - linear_->run(of_own, at);
  }

 private:
  Simulation& own_;
  std::unique_ptr<Simulation> linear_;
};

/// Observer form in standard deviations of the signals as a transfer function in z.
OwnModelOptions transferFunction(const CurveModel& model, const SignalScales& scales,
                                 double sample_time) {
  OwnModelOptions options;
  options.domain = TransferDomain::z;
  options.sample_time = sample_time;
  const int n = model.order;
  options.num = Eigen::VectorXd::Zero(n + 1);
  options.num[0] = model.directGain();
  options.num.tail(n) = model.theta.segment(n, n);
  options.num *= scales.y.unit / scales.u.unit;
  options.den = Eigen::VectorXd::Zero(n + 1 + model.delay);
  options.den[0] = 1;
  options.den.segment(1, n) = model.theta.head(n);
  return options;
}

/// Squared error of the linear model, and squared deviation of the simulation from its mean.
double fitOf(Simulation& linear, const std::vector<Experiment>& answers) {
  double error = 0, count = 0, sum = 0, squares = 0;
  for (const Experiment& each : answers) {
    error += (each.y - linear.run(inputOf(each), ownValuesOf(linear))).squaredNorm();
    count += each.samples();
    sum += each.y.sum();
    squares += each.y.squaredNorm();
  }
  const double power = std::max(squares - sum * sum / count, 1e-300);
  return 100 * (1 - std::sqrt(error / power));
}

}  // namespace

Eigen::VectorXd ownValuesOf(const Simulation& simulation) {
  const std::vector<SimulationParameter> parameters = simulation.parameters();
  Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = parameters[k].value;
  return values;
}

LinearFit fitLinear(const std::vector<Experiment>& answers, const std::string& description) {
  LinearFit best;
  if (answers.empty()) return best;
  WindowPlan plan;
  plan.one_of_each = true;
  const SimulationData data = windowsOf(answers, plan, scalesOf(answers), kMostSamples);
  if (data.scales.u.unit < 1e-9 || data.scales.y.unit < 1e-9) return best;
  WorkerPool pool(1);
  CurveSearchContext context;
  context.pool = &pool;
  for (const WindowFit& fit : fitLinearPlants(data, kMaxOrder, context).of_order) {
    try {
      auto linear = makeLinearSimulation(
          factorsOf(transferFunction(fit.model, data.scales, data.sample_time), data.sample_time),
          description);
      const double reached = fitOf(*linear, answers);
      // A higher order must halve what is left: its poles are to be told as parameters.
      if (100 - reached > 0.5 * (100 - best.fit)) continue;
      best = {std::move(linear), reached};
    } catch (const ConfigurationError&) {
      continue;  // not stable: its parameters mean nothing
    }
  }
  return best;
}

LinearSurrogate fitSurrogate(Simulation& simulation, const std::vector<Experiment>& experiments) {
  std::vector<Experiment> answers;
  for (const Experiment& experiment : experiments) {
    Experiment answer = experiment;
    answer.y = simulation.run(inputOf(experiment), ownValuesOf(simulation));
    answer.valid.clear();
    answer.signals.clear();
    if (answer.y.size() == answer.u.size() && answer.y.allFinite()) answers.push_back(answer);
  }
  LinearFit linear = fitLinear(answers, simulation.description());
  LinearSurrogate surrogate{nullptr, nullptr, linear.fit};
  if (linear.simulation && linear.fit >= kLeastSurrogateFit) {
    surrogate.linear = linear.simulation.get();
    surrogate.simulation =
        std::make_unique<SurrogateSimulation>(simulation, std::move(linear.simulation));
  }
  return surrogate;
}

}  // namespace uncertainty_identification
