#include "estimation/order_fits.h"

#include <cmath>
#include <optional>

#include "estimation/excerpt.h"
#include "estimation/initial_guess.h"
#include "estimation/likelihood.h"
#include "estimation/simulation_fit.h"
#include "math/information_criterion.h"

namespace uncertainty_identification {

using Eigen::VectorXd;

/// One part of three is held out: every third experiment or, of fewer than three, a third of each.
OrderFits::Split OrderFits::splitData(const std::vector<Experiment>& experiments, int part) {
  constexpr int kParts = 3;
  Split split;
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    const Experiment& experiment = experiments[r];
    if (experiments.size() >= kParts) {
      (static_cast<int>(r) % kParts == part ? split.held_out : split.fitted).push_back(experiment);
      continue;
    }
    const int all = experiment.samples(), begin = all * part / kParts;
    const int end = all * (part + 1) / kParts;
    split.held_out.push_back(excerpt(experiment, begin, end - begin));
    if (begin > 0) split.fitted.push_back(excerpt(experiment, 0, begin));
    if (end < all) split.fitted.push_back(excerpt(experiment, end, all - end));
  }
  return split;
}

OrderFits::OrderFits(const Configuration& configuration, double sample_time,
                     const std::vector<Experiment>& experiments, int threads)
    : configuration_(configuration), sample_time_(sample_time), threads_(threads) {
  for (const int part : {2, 1, 0}) {
    Split split = splitData(experiments, part);
    held_out_.insert(held_out_.end(), split.held_out.begin(), split.held_out.end());
    split.fitted = fewerSamples(split.fitted, kEnoughSamples);
    splits_.push_back(std::move(split));
  }
}

OrderFit OrderFits::fit(const NominalModelOptions& options, const VectorXd& start) const {
  std::vector<VectorXd> starts = nominalStarts(*modelOf(options), options, experiments());
  if (start.size() > 0) starts.push_back(start);
  return fitFrom(starts, options, experiments());
}

std::unique_ptr<LinearModel> OrderFits::modelOf(NominalModelOptions options) const {
  options.orders_auto = false;
  ErrorModelOptions none;
  none.taps = 0;
  return std::make_unique<LinearModel>(makeNominalModel(options, sample_time_), ErrorBasis(none),
                                       configuration_.estimation);
}

OrderFit OrderFits::fitFrom(const std::vector<VectorXd>& starts, const NominalModelOptions& options,
                            const std::vector<Experiment>& experiments) const {
  OrderFit fitted;
  fitted.options = options;
  fitted.options.orders_auto = false;
  const std::unique_ptr<LinearModel> model = modelOf(options);
  const std::vector<Block> blocks = makeBlocks(experiments);
  const Likelihood likelihood(*model, blocks, static_cast<int>(experiments.size()), threads_);
  const std::optional<ModelParameters> point =
      bestSingleComponent(likelihood, starts, OptimisationOptions());
  if (!point) return fitted;
  const Statistics statistics = likelihood.statistics(point->parameters, false);
  fitted.parameters = point->parameters;
  fitted.log_likelihood = likelihood.expect(statistics, *point).total();
  fitted.bic =
      bic(fitted.log_likelihood, model->parameterCount() + 1, 0, statistics.samples().sum(), 1);
  return fitted;
}

std::vector<VectorXd> OrderFits::simulate(const OrderFit& fitted,
                                          const std::vector<Experiment>& experiments) const {
  const auto nominal = makeNominalModel(fitted.options, sample_time_);
  const VectorXd theta = fitted.parameters.head(nominal->parameterCount());
  const bool has_offset = fitted.parameters.size() > theta.size();
  return simulationErrors(*nominal, theta, has_offset ? fitted.parameters[theta.size()] : 0.0,
                          configuration_.estimation, experiments);
}

void OrderFits::crossValidate(OrderFit* fitted) const {
  if (fitted->parameters.size() == 0) return;
  const auto finite = [](double fit) { return std::isfinite(fit) ? fit : OrderFit::kWorst; };
  fitted->fit = finite(fitOfErrors(simulate(*fitted, experiments()), experiments())
                           .pooledFor(configuration_.estimation.offsets));
  std::vector<VectorXd> errors;
  for (std::size_t k = 0; k < splits_.size(); ++k) {
    const OrderFit of_split =
        k == 0 ? *fitted : fitFrom({fitted->parameters}, fitted->options, splits_[k].fitted);
    if (of_split.parameters.size() == 0) return;
    for (VectorXd& each : simulate(of_split, splits_[k].held_out))
      errors.push_back(std::move(each));
  }
  fitted->held_out_errors = std::move(errors);
  fitted->held_out_fit = finite(
      fitOfErrors(fitted->held_out_errors, held_out_).pooledFor(configuration_.estimation.offsets));
}

}  // namespace uncertainty_identification
