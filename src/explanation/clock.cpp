#include "clock.h"

#include <limits>

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char* kName = "exp_clock";

/// Every experiment's output taken at the shift of its point.
class FixedShift : public Effect {
 public:
  FixedShift() : Effect(description()) {}

  void apply(const VectorXd& /*psi*/, Chain* chain) const override {
    const Lanes shift = chain->points.row(chain->regressors).transpose().array();
    chain->x = interpolated(chain->x, shift);
    for (Signals& regressor : chain->X) regressor = interpolated(regressor, shift);
  }

 private:
  static EffectDescription description() {
    EffectDescription description;
    description.name = "fixed_shift";
    description.stage = Stage::output;
    return description;
  }
};

}  // namespace

bool hasClock(const ExtendedModel& model) {
  for (const auto& effect : model.effects()) {
    if (effect->name() == kName) return true;
  }
  return false;
}

Index clockColumn(const ExtendedModel& model, Index columns) {
  Index behind = 0;
  bool found = false;
  for (const auto& effect : model.effects()) {
    found = found || effect->name() == kName;
    for (const EffectParameter& parameter : effect->description().parameters)
      behind += found && parameter.log_variance ? (effect->name() == "sens_hum" ? 2 : 1) : 0;
  }
  return columns - behind;
}

MatrixXd clockStart(const ExtendedModel& model, const ModelParameters& at, const FitData& data) {
  constexpr double kSpan = 4, kSpacing = 0.25;  // [samples]
  Effects effects;
  VectorXd parameters = at.parameters;
  for (std::size_t k = 0; k < model.effects().size(); ++k) {
    if (model.effects()[k]->name() != kName) {
      effects.push_back(model.effects()[k]);
      continue;
    }
    effects.push_back(std::make_shared<FixedShift>());
    const Index first = model.offsetOf(k), after = parameters.size() - first - 1;
    parameters.segment(first, after) = parameters.tail(after).eval();
    parameters.conservativeResize(parameters.size() - 1);
  }
  const auto shifted = model.with(effects);
  MatrixXd points = MatrixXd::Zero(model.regressors() + 1, data.count()), best_points = points;
  if (model.currentPoints().cols() == data.count())
    points.topRows(model.regressors()) = model.currentPoints().topRows(model.regressors());
  VectorXd best = VectorXd::Constant(data.count(), -std::numeric_limits<double>::infinity());
  for (double shift = -kSpan; shift <= kSpan; shift += kSpacing) {
    points.bottomRows(1).setConstant(shift);
    const Fit fit =
        evaluated(shifted->about(points), {parameters, at.mixture, at.noise_variance}, data);
    for (int r = 0; r < data.count() && fit.of_experiments.size() > 0; ++r) {
      if (fit.of_experiments[r] <= best[r]) continue;
      best[r] = fit.of_experiments[r];
      best_points.col(r) << fit.xi.col(r), shift;
    }
  }
  return best_points;
}

}  // namespace uncertainty_identification
