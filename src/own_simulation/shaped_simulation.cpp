#include "own_simulation/shaped_simulation.h"

#include <algorithm>
#include <string>
#include <utility>

#include "own_simulation/linear_surrogate.h"

namespace uncertainty_identification {
namespace {

constexpr double kMiddle = 0.5;  ///< of an experiment, where a drifting gain is 1

/// Values of the parameters to begin with. Limits that are seldom reached change little, and are
/// not found from lower ones.
std::vector<std::vector<double>> startsOf(const Shape& shape) {
  std::vector<std::vector<double>> starts = shape.starts;
  if (shape.name == "saturation") starts.insert(starts.end(), {{2.0}, {2.5}, {3.0}});
  return starts;
}

void addShapes(Place place, double unit, const std::vector<std::string>& names,
               std::vector<PlacedShape>* all) {
  for (const Shape& shape : shapes()) {
    if (std::find(names.begin(), names.end(), shape.name) == names.end()) continue;
    for (const std::vector<double>& own : startsOf(shape)) {
      PlacedShape placed{place, &shape, unit, false, Eigen::VectorXd::Ones(shape.count())};
      std::copy(own.begin(), own.end(), placed.start.data() + (shape.is_whole ? 0 : 1));
      all->push_back(placed);
    }
    if (shape.name != "asymmetric_slope") continue;
    all->push_back(all->back());
    all->back().is_mirrored = true;
  }
}

}  // namespace

std::vector<PlacedShape> shapesAround(double input, double output) {
  std::vector<PlacedShape> all;
  addShapes(Place::input, input, {"dead_zone", "saturation", "asymmetric_slope", "square", "cubic"},
            &all);
  addShapes(Place::time_gain, 1, {"linear"}, &all);
  addShapes(Place::sensor, output, {"dead_zone", "saturation", "square", "cubic"}, &all);
  return all;
}

Eigen::VectorXd shaped(const PlacedShape& placed, const Eigen::VectorXd& signal,
                       const Eigen::VectorXd& parameters) {
  const Shape& shape = *placed.shape;
  const double* own = parameters.data() + (shape.is_whole ? 0 : 1);
  const double amplitude = parameters[0] - 1;
  if (placed.place == Place::time_gain)
    return signal.unaryExpr(
        [&](double t) { return 1 + amplitude * shape.value(t - kMiddle, own); });
  const double unit = placed.is_mirrored ? -placed.unit : placed.unit;
  return signal.unaryExpr([&](double each) {
    const double value = unit * shape.value(each / unit, own);
    return shape.is_whole ? value : each + amplitude * value;
  });
}

ShapedSimulation::ShapedSimulation(Simulation& simulation, PlacedShape placed)
    : simulation_(simulation), placed_(std::move(placed)), own_values_(ownValuesOf(simulation)) {}

std::vector<SimulationParameter> ShapedSimulation::parameters() const {
  std::vector<SimulationParameter> all;
  for (Eigen::Index k = 0; k < placed_.start.size(); ++k) all.push_back({"", placed_.start[k], ""});
  return all;
}

Eigen::VectorXd ShapedSimulation::run(const SimulationInput& input, const Eigen::VectorXd& values) {
  constexpr double kFarOff = 1e100;
  if (placed_.place == Place::sensor)
    return shaped(placed_, simulation_.run(input, own_values_), values);
  SimulationInput changed = input;
  changed.u = shaped(placed_, input.u, values);
  if (placed_.place == Place::time_gain)
    changed.u = shaped(placed_, Eigen::VectorXd::LinSpaced(input.u.size(), 0, 1), values)
                    .cwiseProduct(input.u);
  if (changed.measured_u.size() == 0) changed.measured_u = input.u;
  const Eigen::VectorXd y = simulation_.run(changed, own_values_);
  return y.allFinite() ? y : Eigen::VectorXd::Constant(y.size(), kFarOff);
}

}  // namespace uncertainty_identification
