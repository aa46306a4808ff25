#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "model/linear_model.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// A nominal model of some orders without error model, fitted by scoring steps.
struct OrderFit {
  static constexpr double kWorst = -std::numeric_limits<double>::infinity();

  NominalModelOptions options;
  Eigen::VectorXd parameters;  ///< empty if the fit failed
  double log_likelihood = kWorst;
  double bic = std::numeric_limits<double>::quiet_NaN();
  double fit = kWorst;                           ///< of the simulation of the fitted data [%]
  double held_out_fit = kWorst;                  ///< of the simulation of held-out data [%]
  std::vector<Eigen::VectorXd> held_out_errors;  ///< of this simulation; empty if a fit failed
};

/// Fits models of any orders to two thirds of the data, and simulates the third that is held out.
/// The configuration must outlive it.
class OrderFits {
 public:
  OrderFits(const Configuration& configuration, double sample_time,
            const std::vector<Experiment>& experiments, int threads);

  /// The two thirds that fit() uses: all but every third experiment or, of fewer than three, but
  /// the last third of each.
  const std::vector<Experiment>& experiments() const { return splits_.front().fitted; }

  /// From the starts that the data give, and from `start` where it is not empty.
  OrderFit fit(const NominalModelOptions& options,
               const Eigen::VectorXd& start = Eigen::VectorXd()) const;

  /// Adds the fit of the simulation to a model's own data and to all data, each third of them
  /// simulated by the model as fitted to the other two.
  void crossValidate(OrderFit* fitted) const;

 private:
  struct Split {
    std::vector<Experiment> fitted, held_out;
  };

  static Split splitData(const std::vector<Experiment>& experiments, int part);
  std::unique_ptr<LinearModel> modelOf(NominalModelOptions options) const;
  OrderFit fitFrom(const std::vector<Eigen::VectorXd>& starts, const NominalModelOptions& options,
                   const std::vector<Experiment>& experiments) const;
  std::vector<Eigen::VectorXd> simulate(const OrderFit& fitted,
                                        const std::vector<Experiment>& experiments) const;

  const Configuration& configuration_;
  double sample_time_;
  int threads_;
  std::vector<Split> splits_;
  std::vector<Experiment> held_out_;  ///< of all splits
};

}  // namespace uncertainty_identification
