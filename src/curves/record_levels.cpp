#include "curves/record_levels.h"

#include <utility>

#include "curves/held_out.h"
#include "curves/initial_states.h"
#include "curves/plant_orders.h"
#include "curves/window_search.h"
#include "data/bridged_output.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kFewest = 3;  ///< experiments
constexpr int kHighestOrder = 2;

double square(double x) { return x * x; }

/// What a linear plant of low order leaves in windows of the plan [unit of y]^2.
struct Errors {
  double fitted = 0, held = 0;
};

Errors errorsOf(const LevelledRecords& records, const WindowPlan& plan,
                const CurveSearchContext& context) {
  const SignalScales scales = scalesOf(records.fitted, records.held);
  const SimulationData fitted = windowsOf(records.fitted, plan, scales, kMostSamplesOfSearch),
                       held = windowsOf(records.held, plan, scales, kMostSamplesOfSearch);
  const WindowFit plant = fitLinearPlants(fitted, kHighestOrder, context).starts.front();
  const double unit = square(scales.y.unit);
  return {plant.squared_error * unit,
          held.windows.empty() ? 0 : heldOutErrors(held, plant.model).sum() * unit};
}

/// Each signal less its mean.
std::vector<Experiment> centred(std::vector<Experiment> experiments) {
  for (Experiment& experiment : experiments) {
    experiment.y.array() -= bridgedOutput(experiment).mean();
    experiment.u.array() -= experiment.u.mean();
  }
  return experiments;
}

/// A linear plant that simulates whole records, each counted from a level of its own. It starts
/// from the one that simulates deviations from the records' means.
CurveModel plantWithLevels(const std::vector<Experiment>& experiments, const WindowPlan& plan,
                           const WindowPlan& whole, const SignalScales& scales,
                           const CurveSearchContext& context) {
  const SimulationData deviations =
      windowsOf(centred(experiments), plan, scales, kMostSamplesOfSearch);
  CurveModel model = fitLinearPlants(deviations, kHighestOrder, context).starts.front().model;
  model.own_level = true;
  model.theta[model.biasIndex()] = 0;
  model.initial.clear();
  return fitFreely(windowsOf(experiments, whole, scales, kMostSamplesOfSearch), std::move(model),
                   context.limits(20))
      .model;
}

/// Subtracts the levels from which the model counts each record's output.
std::vector<double> subtractLevels(const CurveModel& model, const WindowPlan& whole,
                                   const SignalScales& scales,
                                   std::vector<Experiment>* experiments) {
  const SimulationData data = windowsOf(*experiments, whole, scales, 0);
  const std::vector<Eigen::VectorXd> initial = initialStates(data, model, data.longest);
  std::vector<double> levels(experiments->size(), 0.0);
  for (std::size_t w = 0; w < data.windows.size(); ++w) {  // none of records that are too short
    const auto record = static_cast<std::size_t>(data.windows[w].record);
    levels[record] = initial[w][model.order] * scales.y.unit;
    (*experiments)[record].y.array() -= levels[record];
  }
  return levels;
}

}  // namespace

std::optional<LevelledRecords> countedFromOwnLevels(const std::vector<Experiment>& fitted,
                                                    const std::vector<Experiment>& held,
                                                    const WindowPlan& plan,
                                                    const CurveSearchContext& context) {
  constexpr double kQuarter = 0.25;
  if (fitted.size() < kFewest) return {};
  const SignalScales scales = scalesOf(fitted, held);
  WindowPlan whole = plan;
  whole.one_of_each = whole.own_levels = true;
  const CurveModel model = plantWithLevels(fitted, plan, whole, scales, context);
  LevelledRecords records{fitted, held, {}, {}};
  const Errors common = errorsOf(records, plan, context);
  records.fitted_levels = subtractLevels(model, whole, scales, &records.fitted);
  records.held_levels = subtractLevels(model, whole, scales, &records.held);
  const Errors own = errorsOf(records, plan, context);
  const bool is_better =
      held.empty() ? own.fitted < kQuarter * common.fitted : own.held < kQuarter * common.held;
  if (!is_better) return {};
  return records;
}

}  // namespace uncertainty_identification
