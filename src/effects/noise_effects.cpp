#include <cmath>

#include "effects/built_in_effects.h"
#include "effects/effect_functions.h"
#include "math/polynomial.h"

/// How the noise may differ from what the noise model says: in its spectrum and in its size.
namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// White noise, and pairs of poles across the frequencies. White noise alone would not do: the
/// declared poles may have taken the place of the missing ones, and an optimiser that starts there
/// may end in that local optimum.
std::vector<VectorXd> colourStarts() {
  constexpr double kRadius = 0.7;
  std::vector<VectorXd> all{VectorXd::Zero(2)};
  for (const double frequency : {0.5, 1.0, 1.6, 2.1, 2.6})
    all.push_back(Eigen::Vector2d(-2 * kRadius * std::cos(frequency), kRadius * kRadius));
  return all;
}

/// D is multiplied by 1 + d1 q^-1 + d2 q^-2, which must be stable.
class NoiseColour : public Effect {
 public:
  NoiseColour()
      : Effect(
            {"noise_colour",
             "",
             "disturbance with a spectrum that the noise model cannot describe",
             "Raise the order of the noise model (nc, nd), or look for the disturbance's source.",
             {},
             Stage::measurement,
             ScreeningKind::regression,
             {{"d1", "1", 0.2}, {"d2", "1", 0.2}},
             colourStarts(),
             /*nonlinear=*/false,
             /*own_point=*/false,
             {Trait::of_noise, Trait::noise_poles}}) {}

  bool admissible(const VectorXd& psi) const override { return isStable(psi, 0.999); }

  void apply(const VectorXd& psi, Chain* chain) const override {
    chain->noise_d = multiply(chain->noise_d, psi);
  }
};

/// The innovations' variance is 1 - share + share (s/deviation)^2 times sigma^2, where s is the
/// signal that `of` takes from the chain.
std::shared_ptr<Effect> levelOf(const std::string& variant, const std::string& signal,
                                double deviation, bool nonlinear, Signals (*of)(const Chain&)) {
  return chainEffect(
      {"noise_hetero",
       variant,
       "noise that grows with the " + signal,
       "Look for noise of the actuator, or a sensor whose error is proportional to its reading.",
       {},
       Stage::noise,
       ScreeningKind::likelihood,
       {{"share", "1", 0.2, 0.0, 0.995}},
       values({0.1, 0.3, 0.6, 0.85}),
       nonlinear},
      [deviation, of](const VectorXd& psi, Chain* chain) {
        const Signals relative = of(*chain) / deviation;
        chain->scaleDeviation((1 - psi[0] + psi[0] * relative.square()).max(1e-4).sqrt());
      });
}

}  // namespace

MadeEffects noiseColour(const DataSummary& /*data*/) { return {std::make_shared<NoiseColour>()}; }

MadeEffects noiseLevel(const DataSummary& data) {
  return {levelOf("u", "input", data.input_deviation, false,
                  [](const Chain& chain) { return chain.block.u; }),
          levelOf("x", "output", data.output_deviation, true,
                  [](const Chain& chain) { return chain.expected(); })};
}

/// The innovations' standard deviation changes by a ratio at an instant within each experiment.
MadeEffects noiseStep(const DataSummary& data) {
  return {chainEffect({"noise_step",
                       "",
                       "noise that becomes stronger or weaker during each experiment",
                       "Look for something that is switched on or off at the estimated time.",
                       {},
                       Stage::noise,
                       ScreeningKind::likelihood,
                       {{"ratio", "1", 0.3, 0.02, 50.0}, instantParameter(data)},
                       instantStarts({std::exp(0.5), std::exp(-0.5)}, data)},
                      [sample_time = data.sample_time](const VectorXd& psi, Chain* chain) {
                        const auto on = stepFrom(psi[1] / sample_time, *chain);
                        chain->scaleDeviation(Signals::Ones(kLanes, on.cols()).rowwise() *
                                              ((on - 0.5) * std::log(psi[0])).exp());
                      })};
}

}  // namespace uncertainty_identification
