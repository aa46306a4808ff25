#include "estimation/linearisation.h"
#include "identification/identification.h"

/// Models that are linear in the error parameters only near a point for each experiment: the points
/// are the posterior means (docs/method.md, section on parameters that vary).
namespace uncertainty_identification {

/// Points that belong to the start.
void Identification::settle() {
  Linearisation start = linearisedAtPosteriorMeans(*model_, blocks_, estimate_.experiment_count,
                                                   threads(), at_, &estimate_.passes);
  if (start.model == nullptr) return;
  points_ = start.points;
  adopt(std::move(start.model));
}

/// Climbs and new points in turn until they stand still: then the estimate maximises the likelihood
/// that is linearised about its own posterior means.
void Identification::climbToStandingPoints(const ClimbOptions& options) {
  constexpr int kMostRounds = 50;
  for (int round = 0; model_->isLocallyLinear(); ++round) {
    if (estimate_.termination == Termination::cancelled ||
        estimate_.iterations >= options.max_iterations) {
      return;
    }
    Linearisation next = nextLinearisation(*model_, *likelihood_, at_, points_);
    if (next.move < kStandingStill) return;
    if (round == kMostRounds) break;
    points_ = next.points;
    adopt(std::move(next.model));
    climbOnce(options);
  }
  if (!model_->isLocallyLinear()) return;
  estimate_.termination = Termination::stalled;
  estimate_.message =
      "the points that the model is linearised about did not come to rest; the experiments may be "
      "too short to tell their own parameters";
}

}  // namespace uncertainty_identification
