#include "estimation/simulation_fit.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <memory>

namespace uncertainty_identification {
namespace {

/// The nominal model with white noise and no error model. Its residual, after the nuisances have
/// been eliminated, is the simulation error.
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

/// The simulation error in a lane. The initial state is estimated from the first samples.
Eigen::VectorXd errorOf(const Response& response, const Block& block, int lane) {
  const auto columns = static_cast<Eigen::Index>(response.value.columns.size());
  const int samples = block.lengths[static_cast<std::size_t>(lane)];
  Eigen::VectorXd error = response.value.residual.row(lane).head(samples).transpose();
  if (columns == 0) return error;
  Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(samples, columns);
  for (Eigen::Index k = 0; k < columns; ++k) {
    const Signals& column = *response.value.columns[static_cast<std::size_t>(k)];
    const Eigen::Index known = std::min<Eigen::Index>(samples, column.cols());
    Z.col(k).head(known) = column.row(lane).head(known).transpose();
  }
  error -= Z * initialCoefficients(Z, error);
  return error;
}

/// Number, sum and sum of squares of values.
struct Moments {
  double sum = 0, squares = 0, count = 0;

  void add(const Moments& other) {
    sum += other.sum;
    squares += other.squares;
    count += other.count;
  }
  double spread() const { return squares - sum * sum / count; }
};

Moments momentsOf(const Experiment& experiment) {
  Moments moments;
  for (int k = 0; k < experiment.samples(); ++k) {
    if (experiment.isValid(k)) moments.add({experiment.y[k], experiment.y[k] * experiment.y[k], 1});
  }
  return moments;
}

}  // namespace

Eigen::VectorXd initialCoefficients(const Eigen::MatrixXd& Z, const Eigen::VectorXd& error) {
  Eigen::Index wanted = 20 + 3 * Z.cols(), first = 0;
  for (; first < Z.rows() && wanted > 0; ++first) wanted -= Z.row(first).any() ? 1 : 0;
  return Z.topRows(first).colPivHouseholderQr().solve(error.head(first));
}

std::vector<Eigen::VectorXd> simulationErrors(const NominalModel& nominal,
                                              const Eigen::VectorXd& theta, double offset,
                                              const EstimationOptions& options,
                                              const std::vector<Experiment>& experiments) {
  ErrorModelOptions none;
  none.taps = 0;
  const LinearModel model(std::make_shared<NoiseFree>(nominal), ErrorBasis(none), options);
  Eigen::VectorXd parameters(model.parameterCount());
  parameters.head(theta.size()) = theta;
  if (parameters.size() > theta.size()) parameters[theta.size()] = offset;

  std::vector<Eigen::VectorXd> errors(experiments.size());
  for (const Block& block : makeBlocks(experiments)) {
    Response response;
    model.evaluate(block, parameters, false, &response);
    for (int lane = 0; lane < block.lanes; ++lane) {
      errors[static_cast<std::size_t>(block.index[static_cast<std::size_t>(lane)])] =
          errorOf(response, block, lane);
    }
  }
  return errors;
}

SimulationFit simulationFit(const NominalModel& nominal, const Eigen::VectorXd& theta,
                            double offset, const EstimationOptions& options,
                            const std::vector<Experiment>& experiments) {
  return fitOfErrors(simulationErrors(nominal, theta, offset, options, experiments), experiments);
}

SimulationFit fitOfErrors(const std::vector<Eigen::VectorXd>& errors,
                          const std::vector<Experiment>& experiments) {
  SimulationFit fit;
  Moments all;
  double error = 0, own_spreads = 0;
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    const Moments own = momentsOf(experiments[r]);
    fit.percent.push_back(fitPercent(errors[r].squaredNorm(), own.spread()));
    error += errors[r].squaredNorm();
    own_spreads += own.spread();
    all.add(own);
  }
  fit.pooled = fitPercent(error, all.spread());
  fit.pooled_own_means = fitPercent(error, own_spreads);
  return fit;
}

bool areNoticeablyLarger(const std::vector<Eigen::VectorXd>& one,
                         const std::vector<Eigen::VectorXd>& other) {
  constexpr std::size_t kParts = 10;
  constexpr double kErrors = 2;                                      // standard errors
  const std::size_t parts = (kParts + one.size() - 1) / one.size();  // of each experiment
  Moments difference;
  for (std::size_t r = 0; r < one.size(); ++r) {
    const Eigen::VectorXd more = one[r].array().square() - other[r].array().square();
    for (std::size_t part = 0; part < parts; ++part) {
      const auto edge = [&](std::size_t k) {
        return more.size() * static_cast<Eigen::Index>(k) / static_cast<Eigen::Index>(parts);
      };
      const double sum = more.segment(edge(part), edge(part + 1) - edge(part)).sum();
      difference.add({sum, sum * sum, 1});
    }
  }
  const double freedom = difference.count - 1;
  const double variance_of_sum = difference.count * difference.spread() / freedom;
  return difference.sum > kErrors * std::sqrt(std::max(0.0, variance_of_sum));
}

}  // namespace uncertainty_identification
