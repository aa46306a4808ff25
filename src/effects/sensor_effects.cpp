#include <cmath>

#include "effects/built_in_effects.h"
#include "effects/effect_functions.h"
#include "model/filter.h"

/// What a sensor may do to the plant's output x.
namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// The sensor filters x and the noise alike: (1 - pole)/(1 - pole q^-1). In the likelihood the
/// measurement is filtered by the inverse. Poles near 1 are excluded: there, the inverse takes
/// differences of the data, and so would remove any drift.
class SensorLag : public Effect {
 public:
  SensorLag()
      : Effect({"sens_lag",
                "",
                "lag of the sensor",
                "Look up the sensor's time constant or filter setting; it colours the noise as "
                "well.",
                {"plant_pole", "act_delay"},
                Stage::measurement,
                ScreeningKind::regression,
                {{"pole", "1", 0.2, -0.9, 0.93}},
                values({0.15, 0.5, 0.8}),
                /*nonlinear=*/false,
                /*own_point=*/false,
                {Trait::order, Trait::moves_plant, Trait::differencing}}) {}

  void sense(const VectorXd& psi, Signals* signal) const override {
    Signals out;
    filter(VectorXd::Constant(1, 1 - psi[0]), -psi, 0, *signal, &out);
    signal->swap(out);
  }

  void apply(const VectorXd& psi, Chain* chain) const override {
    const Signals measured = chain->y.size() > 0 ? chain->y : chain->block.y;
    Signals before;
    shift(1, measured, &before);
    chain->y = (measured - psi[0] * before) / (1 - psi[0]);
    chain->log_jacobian -= chain->block.weight.rowwise().sum() * std::log(1 - psi[0]);
  }
};

constexpr const char* kDriftAdvice =
    "Let the sensor warm up; record it with the plant at rest for as long as an experiment.";
constexpr const char* kHumAdvice =
    "Look for the mains, a fan or a pump at the estimated frequency; shield or filter the sensor.";

/// Standard deviations of a random signal to try, as logarithms of the relative variance.
std::vector<VectorXd> deviationStarts() { return values({-4, -2, 1, 4}); }

EffectParameter humFrequency(const DataSummary& data) {
  return {"frequency", "rad/s", 1e-3 / data.sample_time, 1e-3 / data.sample_time,
          3.1415 / data.sample_time};
}

/// y + cosine cos(w t) + sine sin(w t), started at the peaks of the residual's spectrum.
std::shared_ptr<Effect> commonHum(const DataSummary& data) {
  std::vector<VectorXd> starts;
  for (const double peak : {data.common_peak, data.own_peak})
    starts.push_back(Eigen::Vector3d(0, 0, peak / data.sample_time));
  return chainEffect({"sens_hum",
                      "",
                      "hum on the measurement",
                      kHumAdvice,
                      {},
                      Stage::output,
                      ScreeningKind::regression,
                      {{"cosine", "unit of y", data.output_deviation},
                       {"sine", "unit of y", data.output_deviation},
                       humFrequency(data)},
                      starts,
                      /*nonlinear=*/false,
                      /*own_point=*/false,
                      {Trait::spectral_line}},
                     [sample_time = data.sample_time](const VectorXd& psi, Chain* chain) {
                       const auto angle = (chain->time() * (psi[2] * sample_time)).eval();
                       chain->x.rowwise() += psi[0] * angle.cos() + psi[1] * angle.sin();
                     });
}

/// The same with a random phase and amplitude in each experiment.
std::shared_ptr<Effect> ownHum(const DataSummary& data) {
  std::vector<VectorXd> starts;
  for (const double size : {-4.0, -2.0, 0.0, 2.0}) {
    for (const double peak : {data.common_peak, data.own_peak})
      starts.push_back(Eigen::Vector2d(size, peak / data.sample_time));
  }
  return chainEffect({"sens_hum",
                      "per_experiment",
                      "hum on the measurement with a phase that differs by experiment",
                      kHumAdvice,
                      {},
                      Stage::output,
                      ScreeningKind::likelihood,
                      {logVariance("deviation", "unit of y"), humFrequency(data)},
                      starts,
                      /*nonlinear=*/false,
                      /*own_point=*/false,
                      {Trait::by_experiment, Trait::spectral_line}},
                     [sample_time = data.sample_time](const VectorXd& psi, Chain* chain) {
                       const auto angle = (chain->time() * (psi[1] * sample_time)).eval();
                       const Signals ones = Signals::Ones(kLanes, chain->x.cols());
                       chain->random.push_back({ones.rowwise() * angle.cos(), std::exp(psi[0])});
                       chain->random.push_back({ones.rowwise() * angle.sin(), std::exp(psi[0])});
                     });
}

}  // namespace

MadeEffects sensorLag(const DataSummary& /*data*/) { return {std::make_shared<SensorLag>()}; }

/// x + c2 x^2 + c3 x^3.
MadeEffects sensorCurve(const DataSummary& data) {
  return {chainEffect({"sens_wiener",
                       "",
                       "curved characteristic of the sensor",
                       "Calibrate the sensor at several levels.",
                       {},
                       Stage::output,
                       ScreeningKind::regression,
                       {{"c2", "1 per unit of y", 1 / data.output_deviation},
                        {"c3", "1 per unit of y squared", std::pow(data.output_deviation, -2)}},
                       {VectorXd::Zero(2)},
                       /*nonlinear=*/true},
                      [](const VectorXd& psi, Chain* chain) {
                        const Signals x = chain->expected();
                        chain->transform(x + x.square() * (psi[0] + psi[1] * x),
                                         1 + x * (2 * psi[0] + 3 * psi[1] * x));
                      })};
}

/// x clipped at -limit and limit, before noise is added.
MadeEffects sensorClipping(const DataSummary& data) {
  return {chainEffect({"sens_clip",
                       "",
                       "sensor that runs into its limit",
                       "Choose a sensor with a wider range, or excite the plant less.",
                       {},
                       Stage::output,
                       ScreeningKind::regression,
                       {{"limit", "unit of y", data.output_deviation, 1e-3 * data.output_deviation,
                         100 * data.output_deviation}},
                       quantileStarts(data.output_sizes, {0.6, 0.75, 0.85, 0.92, 0.97},
                                      1e-3 * data.output_deviation),
                       /*nonlinear=*/true,
                       /*own_point=*/false,
                       {Trait::output_limit},
                       /*excludes=*/{"sens_wiener"}},
                      [](const VectorXd& psi, Chain* chain) {
                        const Signals x = chain->expected();
                        chain->transform(x.min(psi[0]).max(-psi[0]),
                                         (x.abs() < psi[0]).cast<double>());
                      })};
}

/// y + bias; in the second form, a random bias in each experiment.
MadeEffects sensorBias(const DataSummary& data) {
  return {chainEffect({"sens_bias",
                       "",
                       "constant bias of the sensor",
                       "Read the sensor with the plant at rest; or set estimation.offsets: "
                       "estimate.",
                       {"act_offset"},
                       Stage::output,
                       ScreeningKind::regression,
                       {{"bias", "unit of y", data.output_deviation}},
                       {VectorXd::Zero(1)}},
                      [](const VectorXd& psi, Chain* chain) { chain->x += psi[0]; }),
          chainEffect(
              {"sens_bias",
               "per_experiment",
               "bias of the sensor that differs by experiment",
               "Zero the sensor before each experiment; or set estimation.offsets: "
               "per_experiment.",
               {},
               Stage::output,
               ScreeningKind::likelihood,
               {logVariance("deviation", "unit of y")},
               deviationStarts(),
               /*nonlinear=*/false,
               /*own_point=*/false,
               {Trait::by_experiment}},
              [](const VectorXd& psi, Chain* chain) {
                chain->random.push_back({Signals::Ones(kLanes, chain->x.cols()), std::exp(psi[0])});
              })};
}

/// y + drift t/N over each experiment of N samples; in the second form, a random drift in each.
MadeEffects sensorDrift(const DataSummary& data) {
  return {chainEffect({"sens_drift",
                       "",
                       "sensor that drifts during each experiment",
                       kDriftAdvice,
                       {},
                       Stage::output,
                       ScreeningKind::regression,
                       {{"drift", "unit of y per experiment", data.output_deviation}},
                       {VectorXd::Zero(1)}},
                      [](const VectorXd& psi, Chain* chain) {
                        chain->x += psi[0] * chain->relativeTime();
                      }),
          chainEffect({"sens_drift",
                       "per_experiment",
                       "drift of the sensor that differs by experiment",
                       kDriftAdvice,
                       {},
                       Stage::output,
                       ScreeningKind::likelihood,
                       {logVariance("deviation", "unit of y per experiment")},
                       deviationStarts(),
                       /*nonlinear=*/false,
                       /*own_point=*/false,
                       {Trait::by_experiment}},
                      [](const VectorXd& psi, Chain* chain) {
                        chain->random.push_back({chain->relativeTime(), std::exp(psi[0])});
                      })};
}

MadeEffects sensorHum(const DataSummary& data) { return {commonHum(data), ownHum(data)}; }

}  // namespace uncertainty_identification
