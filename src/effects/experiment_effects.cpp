#include <algorithm>
#include <cmath>

#include "effects/built_in_effects.h"
#include "effects/effect_functions.h"
#include "model/filter.h"

/// What may be wrong with an experiment rather than with the rig: an input that was left out, and
/// instants of sampling other than assumed.
namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// The output is sampled tau_r later in each experiment, tau_r random. It is linearised about the
/// shift of each experiment known so far; the rest is a random multiple of dx/dt.
class ClockOffset : public Effect {
 public:
  ClockOffset()
      : Effect(
            {"exp_clock",
             "",
             "dead time that differs by experiment, in the plant or between the clocks of input "
             "and output",
             "Stamp command and measurement by one clock, or send a common trigger; if they are, "
             "look for what delays the plant.",
             {},
             Stage::output,
             ScreeningKind::likelihood,
             {logVariance("deviation", "samples")},
             values({0, 3, 6}),
             /*nonlinear=*/true,
             /*own_point=*/true,
             {Trait::own_shifts, Trait::by_experiment}}) {}

  void apply(const VectorXd& psi, Chain* chain) const override {
    constexpr double kStep = 0.05;
    const Signals expected = chain->expected();
    const Lanes shift = chain->ownPoint();
    const Signals slope = (interpolated(expected, Lanes(shift + kStep)) -
                           interpolated(expected, Lanes(shift - kStep))) /
                          (2 * kStep);
    chain->x = interpolated(chain->x, shift) - slope.colwise() * shift;
    for (Signals& regressor : chain->X) regressor = interpolated(regressor, shift);
    for (RandomSignal& signal : chain->random) signal.z = interpolated(signal.z, shift);
    chain->random.push_back({slope, std::exp(psi[0]), chain->ownPoint(), chain->own_point});
  }

  double pointAt(double size, const NominalModel& /*nominal*/,
                 const VectorXd& /*theta*/) const override {
    constexpr double kLargest = 8;  // [samples] beyond that the linearisation is too coarse
    return std::clamp(size, -kLargest, kLargest);
  }
};

/// x + gain (1 - pole) q^-1/(1 - pole q^-1) d for a covariate d.
std::shared_ptr<Effect> secondInputOf(const std::string& covariate, const DataSummary& data) {
  std::vector<VectorXd> starts;
  for (const double pole : {0.1, 0.6, 0.9})
    starts.push_back(Eigen::Vector2d(0.2 * data.output_deviation, pole));
  return chainEffect({"exp_input2",
                      covariate,
                      covariate + " acts on the output as a second input",
                      "Take " + covariate + " into the model as an input, or keep it constant.",
                      {},
                      Stage::output,
                      ScreeningKind::regression,
                      {{"gain", "unit of y per unit of " + covariate, data.output_deviation},
                       {"pole", "1", 0.2, -0.95, 0.995}},
                      starts},
                     [covariate](const VectorXd& psi, Chain* chain) {
                       Signals response;
                       VectorXd numerator = VectorXd::Zero(2);
                       numerator[1] = psi[0] * (1 - psi[1]);
                       filter(numerator, VectorXd::Constant(1, -psi[1]), 0,
                              chain->covariate(covariate), &response);
                       chain->x += response;
                     });
}

}  // namespace

/// One effect for each covariate.
MadeEffects secondInput(const DataSummary& data) {
  MadeEffects all;
  for (const auto& [name, mean] : data.covariates) all.push_back(secondInputOf(name, data));
  return all;
}

/// The output is sampled at x(t + share d(t)), where d is how far the stamps are off the grid. At
/// share 1 the stamps are right; at 0 the sampling was regular whatever they say.
MadeEffects samplingJitter(const DataSummary& data) {
  if (!data.stamps) return {};
  return {chainEffect(
      {"exp_jitter",
       "",
       "output that was sampled at irregular instants, as its stamps say",
       "Sample on a timer, or resample by the stamps (resampling.output: linear).",
       {},
       Stage::output,
       ScreeningKind::regression,
       {{"share", "1", 0.5, -1.0, 3.0}},
       values({0.5, 1})},
      [sample_time = data.sample_time](const VectorXd& psi, Chain* chain) {
        Signals shift = Signals::Zero(kLanes, chain->x.cols());
        for (int lane = 0; lane < chain->block.lanes; ++lane) {
          const VectorXd& offset =
              chain->block.experiments[static_cast<std::size_t>(lane)]->stamp_offset;
          shift.row(lane).head(offset.size()) = psi[0] / sample_time * offset.transpose().array();
        }
        chain->x = interpolated(chain->x, shift);
        for (Signals& regressor : chain->X) regressor = interpolated(regressor, shift);
      })};
}

MadeEffects clockOffset(const DataSummary& /*data*/) { return {std::make_shared<ClockOffset>()}; }

}  // namespace uncertainty_identification
