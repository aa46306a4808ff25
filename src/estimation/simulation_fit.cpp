#include "uncertainty_identification/estimation/simulation_fit.h"

#include <cmath>
#include <memory>

namespace uncertainty_identification {
namespace {

/// The nominal model with white noise and no error model: its residual, nuisances absorbed, is the simulation error.
class NoiseFree : public NominalModel {
 public:
  explicit NoiseFree(const NominalModel& of) : of_(of) {}
  std::string structure() const override { return of_.structure(); }
  std::vector<std::string> names() const override { return of_.names(); }
  Polynomials polynomials(const Eigen::VectorXd& theta) const override {
    Polynomials p = of_.polynomials(theta);
    p.c.resize(0);
    p.d.resize(0);
    return p;
  }

 private:
  const NominalModel& of_;
};

double fitPercent(double error, double spread) { return 100 * (1 - std::sqrt(error / spread)); }

}  // namespace

SimulationFit simulationFit(const NominalModel& nominal, const Eigen::VectorXd& theta, double offset,
                            const EstimationOptions& options, const std::vector<Experiment>& experiments) {
  ErrorModelOptions none;
  none.taps = 0;
  const LinearModel model(std::shared_ptr<const NominalModel>(std::make_shared<NoiseFree>(nominal)), ErrorBasis(none),
                          options);
  Eigen::VectorXd parameters(model.parameterCount());
  parameters.head(theta.size()) = theta;
  if (parameters.size() > theta.size()) parameters[theta.size()] = offset;
  Statistics statistics(static_cast<int>(experiments.size()), 0, 0);
  for (const Block& block : makeBlocks(experiments)) computeStatistics(model, block, parameters, &statistics);

  SimulationFit fit;
  double error = 0, sum = 0, squares = 0, count = 0;
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    const Experiment& experiment = experiments[r];
    double own_sum = 0, own_squares = 0;
    for (int k = 0; k < experiment.samples(); ++k) {
      if (!experiment.isValid(k)) continue;
      own_sum += experiment.y[k];
      own_squares += experiment.y[k] * experiment.y[k];
    }
    const double own_error = std::max(statistics.gram(static_cast<int>(r))(0, 0), 0.0);
    const double own_count = experiment.validSamples();
    fit.percent.push_back(fitPercent(own_error, own_squares - own_sum * own_sum / own_count));
    error += own_error;
    sum += own_sum;
    squares += own_squares;
    count += own_count;
  }
  fit.pooled = fitPercent(error, squares - sum * sum / count);
  return fit;
}

}  // namespace uncertainty_identification
