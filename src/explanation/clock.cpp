#include "explanation/clock.h"

#include <limits>

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Shifts the output of each experiment by the shift that its point states, without uncertainty.
class FixedShift : public Effect {
 public:
  FixedShift() : Effect(description()) {}

  void apply(const VectorXd& /*psi*/, Chain* chain) const override {
    const Lanes shift = chain->ownPoint();
    chain->x = interpolated(chain->x, shift);
    for (Signals& regressor : chain->X) regressor = interpolated(regressor, shift);
    for (RandomSignal& signal : chain->random) signal.z = interpolated(signal.z, shift);
  }

 private:
  static EffectDescription description() {
    EffectDescription description;
    description.name = "fixed_shift";
    description.stage = Stage::output;
    description.own_point = true;
    return description;
  }
};

}  // namespace

bool hasClock(const ExtendedModel& model) {
  for (const auto& effect : model.effects()) {
    if (effect->has(Trait::own_shifts)) return true;
  }
  return false;
}

MatrixXd clockStart(const ExtendedModel& model, const ModelParameters& at, const FitData& data) {
  constexpr double kSpan = 4, kSpacing = 0.25;  // [samples]
  Effects effects;
  VectorXd parameters = at.parameters;
  Index row = 0;
  for (std::size_t k = 0; k < model.effects().size(); ++k) {
    if (!model.effects()[k]->has(Trait::own_shifts)) {
      effects.push_back(model.effects()[k]);
      continue;
    }
    effects.push_back(std::make_shared<FixedShift>());
    row = model.pointRow(k);
    const Index first = model.offsetOf(k), after = parameters.size() - first - 1;
    parameters.segment(first, after) = parameters.tail(after).eval();
    parameters.conservativeResize(parameters.size() - 1);
  }
  const auto shifted = model.with(effects);
  MatrixXd xi = MatrixXd::Zero(model.regressors(), data.count());
  if (model.currentPoints().cols() == data.count())
    xi = model.currentPoints().topRows(model.regressors());
  MatrixXd points = model.points(at.parameters, xi), best_points = points;
  VectorXd best = VectorXd::Constant(data.count(), -std::numeric_limits<double>::infinity());
  for (double shift = -kSpan; shift <= kSpan; shift += kSpacing) {
    points.row(row).setConstant(shift);
    const Fit fit =
        evaluated(shifted->about(points), {parameters, at.mixture, at.noise_variance}, data);
    for (int r = 0; r < data.count() && fit.of_experiments.size() > 0; ++r) {
      if (fit.of_experiments[r] <= best[r]) continue;
      best[r] = fit.of_experiments[r];
      best_points.col(r).head(model.regressors()) = fit.xi.col(r);
      best_points(row, r) = shift;
    }
  }
  return best_points;
}

}  // namespace uncertainty_identification
