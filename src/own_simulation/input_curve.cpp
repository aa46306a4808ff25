#include "own_simulation/input_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace uncertainty_identification {
namespace {

class BehindInputCurve : public Simulation {
 public:
  BehindInputCurve(Simulation& simulation, double half_width, double limit)
      : simulation_(simulation), half_width_(half_width), limit_(limit) {}

  std::string description() const override { return simulation_.description(); }
  std::vector<SimulationParameter> parameters() const override { return simulation_.parameters(); }
  bool canRerun() const override { return simulation_.canRerun(); }

  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    SimulationInput changed = input;
    for (double& u : changed.u)
      u = std::copysign(std::min(std::max(std::abs(u) - half_width_, 0.0), limit_), u);
    return simulation_.run(changed, values);
  }

 private:
  Simulation& simulation_;
  const double half_width_, limit_;
};

}  // namespace

std::unique_ptr<Simulation> behindInputCurve(Simulation& simulation, const SimulationCause& cause) {
  const std::string& shape = cause.what.shape;
  const bool is_known =
      shape == "dead_zone" || shape == "saturation" || shape == "dead_zone_saturation";
  if (cause.what.place != "input" || !is_known || !simulation.canRerun()) return nullptr;
  double half_width = 0, limit = std::numeric_limits<double>::infinity();
  for (const ShapeValue& value : cause.values) {
    if (value.name == "half_width") half_width = std::abs(value.value);
    if (value.name == "limit") limit = std::abs(value.value);
  }
  return std::make_unique<BehindInputCurve>(simulation, half_width, limit);
}

}  // namespace uncertainty_identification
