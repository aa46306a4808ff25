#include <cmath>
#include <limits>

#include "effects/built_in_effects.h"
#include "effects/effect_functions.h"
#include "model/filter.h"

/// What an actuator may do to its command u before the plant receives it.
namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// Whether a value is, but for a small part, a multiple of the step.
bool isMultiple(double value, double step) {
  constexpr double kClose = 0.03;  // of a step, to which levels are found
  return std::abs(std::remainder(value, step)) < kClose * step;
}

std::vector<VectorXd> joined(std::vector<VectorXd> first, const std::vector<VectorXd>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

/// u + offset.
MadeEffects actuatorOffset(const DataSummary& data) {
  return {chainEffect(
      {"act_offset",
       "",
       "constant added to the actuator's command",
       "Read the actuator with the command at zero; a step of the command from rest distinguishes "
       "it from a bias of the sensor.",
       {"sens_bias"},
       Stage::actuator,
       ScreeningKind::regression,
       {{"offset", "unit of u", data.input_deviation}},
       {VectorXd::Zero(1)},
       /*nonlinear=*/false,
       /*own_point=*/false,
       /*traits=*/{Trait::constant},
       /*excludes=*/{"sens_bias"}},
      [](const VectorXd& psi, Chain* chain) { chain->u += psi[0]; })};
}

/// u(t - delay), interpolated linearly between samples.
MadeEffects actuatorDelay(const DataSummary& data) {
  return {chainEffect({"act_delay",
                       "",
                       "dead time that the model lacks",
                       "Compare the stamps of command and measurement, and look for transport or "
                       "communication delays.",
                       {"plant_pole", "sens_lag"},
                       Stage::actuator,
                       ScreeningKind::regression,
                       {{"delay", "samples", 0.3, 0.0, data.samples / 4.0}},
                       values({0.3, 0.7, 1, 1.5, 2, 3, 4, 5, 7, 10}),
                       /*nonlinear=*/false,
                       /*own_point=*/false,
                       {Trait::order, Trait::moves_plant, Trait::many_optima}},
                      [](const VectorXd& psi, Chain* chain) {
                        const int whole = static_cast<int>(psi[0]);
                        const double rest = psi[0] - whole;
                        const Signals u = chain->u;
                        chain->u.setZero();
                        addShifted(1 - rest, whole, u, &chain->u);
                        addShifted(rest, whole + 1, u, &chain->u);
                      })};
}

/// level + step round((u - level)/step), with a level of 0 or, of the variant, one that is
/// estimated. The likelihood is far from smooth in the step, so the starts are dense; the variant
/// starts from what the residuals show.
MadeEffects actuatorQuantisation(const DataSummary& data) {
  constexpr int kStarts = 45;
  std::vector<VectorXd> starts;
  starts.reserve(kStarts);
  for (int k = 0; k < kStarts; ++k)
    starts.push_back(
        VectorXd::Constant(1, 0.12 * data.input_deviation * std::pow(20.0, k / (kStarts - 1.0))));
  const auto quantisation = [&](const char* variant, std::vector<EffectParameter> parameters,
                                const std::vector<VectorXd>& from) {
    return chainEffect({"act_quantisation",
                        variant,
                        "actuator that moves in steps",
                        "Check the resolution of the actuator's command (converter, valve "
                        "positioner, integer message).",
                        {},
                        Stage::actuator,
                        ScreeningKind::regression,
                        std::move(parameters),
                        from,
                        /*nonlinear=*/false,
                        /*own_point=*/false,
                        {Trait::one_cause}},
                       [](const VectorXd& psi, Chain* chain) {
                         const double level = psi.size() > 1 ? psi[1] : 0;
                         chain->u = level + psi[0] * ((chain->u - level) / psi[0]).round();
                       });
  };
  const auto step = [&](double scale, double most) {
    return EffectParameter{
        "step", "unit of u", scale, 1e-6 * data.input_deviation, most * data.input_deviation,
        false};
  };
  constexpr double kAny = std::numeric_limits<double>::infinity();
  const double first = data.input_step > 0 ? data.input_step : data.input_deviation;
  std::vector<VectorXd> seen;
  if (data.input_step > 0 && isMultiple(data.input_level, data.input_step))
    starts.push_back(VectorXd::Constant(1, data.input_step));
  else if (data.input_step > 0)
    seen.push_back(Eigen::Vector2d(data.input_step, data.input_level));
  return {
      quantisation("", {step(data.input_deviation, 10)}, starts),
      quantisation("shifted",
                   {step(first, 1000), {"level", "unit of u", first, -kAny, kAny, false}}, seen)};
}

/// sign(u) max(|u| - width, 0).
MadeEffects actuatorDeadZone(const DataSummary& data) {
  return {
      chainEffect({"act_deadzone",
                   "",
                   "dead zone of the actuator",
                   "Raise the command slowly from zero and note where the output begins to move.",
                   {},
                   Stage::actuator,
                   ScreeningKind::regression,
                   {{"width", "unit of u", data.input_deviation, 0.0, 5 * data.input_deviation}},
                   joined(quantileStarts(data.input_sizes, {0.05, 0.12, 0.2, 0.3, 0.45},
                                         0.02 * data.input_deviation),
                          values({0.1, 0.2}, data.input_deviation))},
                  [](const VectorXd& psi, Chain* chain) {
                    const Signals& u = chain->u;
                    chain->u = (u - psi[0]).max(0.0) + (u + psi[0]).min(0.0);
                  })};
}

/// The play operator: the output stays where it is until the input has crossed the gap.
MadeEffects actuatorBacklash(const DataSummary& data) {
  return {chainEffect(
      {"act_backlash",
       "",
       "backlash (play) between command and plant",
       "Reverse the command slowly and measure how far it goes before the output follows.",
       {},
       Stage::actuator,
       ScreeningKind::regression,
       {{"width", "unit of u", data.input_deviation, 0.0, 10 * data.input_deviation}},
       values({0.1, 0.3, 0.7, 1.4}, data.input_deviation)},
      [](const VectorXd& psi, Chain* chain) {
        const double half = psi[0] / 2;
        Lanes position = Lanes::Zero();
        for (Eigen::Index t = 0; t < chain->u.cols(); ++t) {
          position = position.max(chain->u.col(t) - half).min(chain->u.col(t) + half);
          chain->u.col(t) = position;
        }
      })};
}

/// The actuator follows its command by at most `rate` per sample.
MadeEffects actuatorRateLimit(const DataSummary& data) {
  return {chainEffect({"act_ratelimit",
                       "",
                       "limited rate of the actuator",
                       "Step the command and record the actuator's own position.",
                       {},
                       Stage::actuator,
                       ScreeningKind::regression,
                       {{"rate", "unit of u per sample", data.input_deviation,
                         1e-4 * data.input_deviation, 100 * data.input_deviation}},
                       joined(quantileStarts(data.input_steps, {0.3, 0.5, 0.7, 0.85, 0.95},
                                             1e-3 * data.input_deviation),
                              values({0.1, 0.3, 1.0}, data.input_deviation))},
                      [](const VectorXd& psi, Chain* chain) {
                        Lanes position = Lanes::Zero();
                        for (Eigen::Index t = 0; t < chain->u.cols(); ++t) {
                          position += (chain->u.col(t) - position).min(psi[0]).max(-psi[0]);
                          chain->u.col(t) = position;
                        }
                      })};
}

/// u clipped at -limit and limit.
MadeEffects actuatorSaturation(const DataSummary& data) {
  return {chainEffect(
      {"act_saturation",
       "",
       "saturation of the actuator",
       "Compare the largest commands with the actuator's rating, or use smaller commands.",
       {},
       Stage::actuator,
       ScreeningKind::regression,
       {{"limit", "unit of u", data.input_deviation, 1e-3 * data.input_deviation,
         100 * data.input_deviation}},
       quantileStarts(data.input_sizes, {0.4, 0.55, 0.7, 0.8, 0.88, 0.94, 0.98},
                      1e-3 * data.input_deviation)},
      [](const VectorXd& psi, Chain* chain) { chain->u = chain->u.min(psi[0]).max(-psi[0]); })};
}

/// u + c2 u^2 + c3 u^3.
MadeEffects actuatorCurve(const DataSummary& data) {
  return {chainEffect(
      {"act_hammerstein",
       "",
       "curved characteristic of the actuator",
       "Measure the actuator's static characteristic, command against force, flow or current.",
       {},
       Stage::actuator,
       ScreeningKind::regression,
       {{"c2", "1 per unit of u", 1 / data.input_deviation},
        {"c3", "1 per unit of u squared", std::pow(data.input_deviation, -2)}},
       {VectorXd::Zero(2)}},
      [](const VectorXd& psi, Chain* chain) {
        const Signals& u = chain->u;
        chain->u = u + u.square() * (psi[0] + psi[1] * u);
      })};
}

/// u until an instant, u (1 - share) from then on.
MadeEffects actuatorLoss(const DataSummary& data) {
  return {chainEffect({"act_loss",
                       "",
                       "actuator that loses effectiveness during the experiment",
                       "Look for what happened to the actuator at the estimated time: a part that "
                       "came loose, a supply that broke down.",
                       {},
                       Stage::actuator,
                       ScreeningKind::regression,
                       {{"share", "1", 0.1, -3.0, 1.0}, instantParameter(data)},
                       instantStarts({0.15}, data)},
                      [sample_time = data.sample_time](const VectorXd& psi, Chain* chain) {
                        chain->u.rowwise() *= 1 - psi[0] * stepFrom(psi[1] / sample_time, *chain);
                      })};
}

}  // namespace uncertainty_identification
