#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

constexpr const char* kAdvice =
    "Look for the mains, a fan or a pump at the frequency named; shield or filter the sensor.";

EffectParameter frequency(const DataSummary& data) {
  return {"frequency", "rad/s", 1e-3 / data.sample_time, 1e-3 / data.sample_time,
          3.1415 / data.sample_time};
}

std::vector<VectorXd> starts(const std::vector<double>& before, const DataSummary& data) {
  std::vector<VectorXd> all;
  for (const double peak : {data.common_peak, data.own_peak}) {
    VectorXd start(static_cast<Eigen::Index>(before.size()) + 1);
    for (std::size_t i = 0; i < before.size(); ++i) start[static_cast<Eigen::Index>(i)] = before[i];
    start[start.size() - 1] = peak / data.sample_time;
    all.push_back(start);
  }
  return all;
}

/// y + a cos(w t) + b sin(w t).
class SensorHum : public Effect {
 public:
  explicit SensorHum(const DataSummary& data)
      : Effect({"sens_hum",
                "",
                "hum on the measurement",
                kAdvice,
                {},
                Stage::output,
                ScreeningKind::regression,
                {{"cosine", "unit of y", data.output_deviation},
                 {"sine", "unit of y", data.output_deviation},
                 frequency(data)},
                starts({0, 0}, data)}),
        sample_time_(data.sample_time) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const auto angle = (chain->time() * (psi[2] * sample_time_)).eval();
    chain->x.rowwise() += psi[0] * angle.cos() + psi[1] * angle.sin();
  }

 private:
  double sample_time_;
};

/// The same with a random phase and amplitude in each experiment.
class OwnSensorHum : public Effect {
 public:
  explicit OwnSensorHum(const DataSummary& data)
      : Effect({"sens_hum",
                "per_experiment",
                "hum on the measurement, its phase differing by experiment",
                kAdvice,
                {},
                Stage::output,
                ScreeningKind::likelihood,
                {logVariance("deviation", "unit of y"), frequency(data)},
                grid(data)}),
        sample_time_(data.sample_time) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    const auto angle = (chain->time() * (psi[1] * sample_time_)).eval();
    const Signals ones = Signals::Ones(kLanes, chain->x.cols());
    chain->random.push_back({ones.rowwise() * angle.cos(), std::exp(psi[0])});
    chain->random.push_back({ones.rowwise() * angle.sin(), std::exp(psi[0])});
  }

 private:
  static std::vector<VectorXd> grid(const DataSummary& data) {
    std::vector<VectorXd> all;
    for (const double size : {-4.0, -2.0, 0.0, 2.0}) {
      for (VectorXd& start : starts({size}, data)) all.push_back(std::move(start));
    }
    return all;
  }

  double sample_time_;
};

const EffectRegistration kRegistration(140, [](const DataSummary& data) -> MadeEffects {
  return {std::make_shared<SensorHum>(data), std::make_shared<OwnSensorHum>(data)};
});
}  // namespace
}  // namespace uncertainty_identification
