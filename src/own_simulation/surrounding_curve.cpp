#include "own_simulation/surrounding_curve.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "own_simulation/change_fit.h"
#include "own_simulation/linear_surrogate.h"

namespace uncertainty_identification {
namespace {

double valueNamed(const SimulationCause& cause, const std::string& name, double absent) {
  for (const ShapeValue& value : cause.values)
    if (value.name == name) return std::abs(value.value);
  return absent;
}

/// Dead zones and limits by their own values. No points: it is another shape.
OwnCurve exactCurve(const SimulationCause& cause) {
  const std::string& shape = cause.what.shape;
  OwnCurve curve{"input", {}, {}};
  const bool is_dead = shape == "dead_zone" || shape == "dead_zone_saturation";
  const bool is_limited = shape == "saturation" || shape == "dead_zone_saturation";
  if (!is_dead && !is_limited && shape != "asymmetric_dead_zone") return curve;
  const double half = is_dead ? valueNamed(cause, "half_width", 0) : 0;
  const double above = valueNamed(cause, "width_above", half);
  const double below = valueNamed(cause, "width_below", half);
  const double length = is_limited ? valueNamed(cause, "limit", 0) : std::max(above + below, 1.0);
  curve.signal = {-below - length, -below, above, above + length};
  curve.value = {-length, 0, 0, length};
  if (!is_limited) return curve;
  const double flat = std::max(length, 1e-9);
  curve.signal.insert(curve.signal.begin(), curve.signal.front() - flat);
  curve.value.insert(curve.value.begin(), -length);
  curve.signal.push_back(curve.signal.back() + flat);
  curve.value.push_back(length);
  return curve;
}

/// The points of a picture. Where the data end, a curve without a shape ends: a characteristic goes
/// on with slope 1, a factor without a change.
OwnCurve drawnCurve(const SimulationCause& cause) {
  const std::string& place = cause.what.place;
  const bool is_factor = place == "time_gain" || place == "covariate_gain";
  OwnCurve curve{place == "time_gain"        ? "time"
                 : place == "covariate_gain" ? cause.what.covariate
                 : place == "sensor"         ? "output"
                                             : "input",
                 cause.curve.signal, cause.curve.value};
  if (curve.signal.empty()) return curve;
  if (is_factor)
    for (double& value : curve.value) value += 1;
  if (cause.what.shape != "curve") return curve;
  const double range = curve.signal.back() - curve.signal.front();
  const double rise = is_factor ? 0 : range;
  curve.signal.insert(curve.signal.begin(), curve.signal.front() - range);
  curve.value.insert(curve.value.begin(), curve.value.front() - rise);
  curve.signal.push_back(curve.signal.back() + range);
  curve.value.push_back(curve.value.back() + rise);
  return curve;
}

double valueAt(const OwnCurve& curve, double x) {
  const auto& signal = curve.signal;
  const auto above = std::upper_bound(signal.begin() + 1, signal.end() - 1, x);
  const auto k = static_cast<std::size_t>(above - signal.begin());
  const double share = (x - signal[k - 1]) / (signal[k] - signal[k - 1]);
  return curve.value[k - 1] + share * (curve.value[k] - curve.value[k - 1]);
}

/// What goes into a curve before the simulation.
Eigen::VectorXd argumentOf(const OwnCurve& curve, const SimulationInput& input) {
  if (curve.of == "input") return input.u;
  if (curve.of == "time") return Eigen::VectorXd::LinSpaced(input.u.size(), 0, 1);
  if (const auto found = input.signals.find(curve.of); found != input.signals.end())
    return found->second;
  const auto constant = input.scalars.find(curve.of);
  return Eigen::VectorXd::Constant(input.u.size(),
                                   constant == input.scalars.end() ? 0 : constant->second);
}

class CurvedSimulation : public Simulation {
 public:
  CurvedSimulation(Simulation& simulation, OwnCurve curve)
      : simulation_(simulation), curve_(std::move(curve)) {}

  std::string description() const override { return simulation_.description(); }
  std::vector<SimulationParameter> parameters() const override { return simulation_.parameters(); }
  bool canRerun() const override { return simulation_.canRerun(); }

  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    return runScaled(input, values, 1, 0);
  }

 protected:
  Eigen::VectorXd runScaled(const SimulationInput& input, const Eigen::VectorXd& values,
                            double scale, double offset) {
    if (curve_.of == "output")
      return valuesAt(curve_, (scale * simulation_.run(input, values).array() + offset).matrix());
    SimulationInput changed = input;
    const Eigen::VectorXd through =
        (scale * valuesAt(curve_, argumentOf(curve_, input)).array() + offset).matrix();
    changed.u = curve_.of == "input" ? through : Eigen::VectorXd(through.cwiseProduct(input.u));
    if (changed.measured_u.size() == 0) changed.measured_u = input.u;
    return simulation_.run(changed, values);
  }

  Simulation& simulation_;
  const OwnCurve curve_;
};

/// Its parameters are the scale and the offset of the curve.
class ScalableSimulation : public CurvedSimulation {
 public:
  ScalableSimulation(Simulation& simulation, const OwnCurve& curve)
      : CurvedSimulation(simulation, curve), own_values_(ownValuesOf(simulation)) {}

  std::vector<SimulationParameter> parameters() const override {
    std::vector<SimulationParameter> both{{"scale", 1, ""}};
    if (curve_.of == "input" || curve_.of == "output") both.push_back({"offset", 0, ""});
    return both;
  }

  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    return runScaled(input, own_values_, values[0], values.size() > 1 ? values[1] : 0);
  }

 private:
  const Eigen::VectorXd own_values_;
};

}  // namespace

std::optional<SurroundingCurve> surroundingCurve(const SimulationCause& cause) {
  const std::string& place = cause.what.place;
  if (place != "input" && place != "sensor" && place != "time_gain" && place != "covariate_gain")
    return std::nullopt;
  SurroundingCurve around{place == "input" ? exactCurve(cause) : OwnCurve(), true};
  if (around.curve.signal.empty()) around = {drawnCurve(cause), false};
  if (around.curve.signal.size() < 2) return std::nullopt;
  return around;
}

Eigen::VectorXd valuesAt(const OwnCurve& curve, const Eigen::VectorXd& signal) {
  return signal.unaryExpr([&curve](double x) { return valueAt(curve, x); });
}

std::unique_ptr<Simulation> withCurve(Simulation& simulation, const OwnCurve& curve) {
  return std::make_unique<CurvedSimulation>(simulation, curve);
}

OwnCurve scaledTo(Simulation& simulation, const OwnCurve& curve, const ComparedData& data, int most,
                  const std::function<bool(int)>& keep_going, int* count) {
  ScalableSimulation scalable(simulation, curve);
  SimulationRuns runs(scalable, most, keep_going);
  const ChangedSimulation changed(runs, data);
  Changes changes;
  for (int k = 0; k < runs.ownValues().size(); ++k)
    changes.push_back({ChangeKind::parameter, k, Eigen::VectorXd::Zero(1)});
  const Eigen::VectorXd best = changed.values(fitChanges(changed, data, changes).changes);
  *count += runs.count();
  const double scale = best[0], offset = best.size() > 1 ? best[1] : 0;
  OwnCurve scaled = curve;
  if (curve.of == "output")
    for (double& signal : scaled.signal) signal = (signal - offset) / scale;
  else
    for (double& value : scaled.value) value = scale * value + offset;
  return scaled;
}

}  // namespace uncertainty_identification
