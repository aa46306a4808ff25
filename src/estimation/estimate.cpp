#include "uncertainty_identification/estimation/estimate.h"

#include <cmath>

namespace uncertainty_identification {

std::string toString(Termination termination) {
  switch (termination) {
    case Termination::converged:
      return "converged";
    case Termination::iteration_limit:
      return "iteration_limit";
    case Termination::stalled:
      return "stalled";
    case Termination::cancelled:
      return "cancelled";
    case Termination::time_limit:
      return "time_limit";
    default:
      return "not_run";
  }
}

bool Estimate::usable() const {
  // An estimation that was not run leaves no model, but max_iterations 0 evaluates one.
  const NominalModelEstimate& m = nominal_model;
  return termination != Termination::cancelled && std::isfinite(log_likelihood) &&
         noise_variance.value > 0 && std::isfinite(noise_variance.value) && m.b.size() > 0 &&
         m.b.allFinite() && m.a.allFinite() && m.c.allFinite() && m.d.allFinite();
}

}  // namespace uncertainty_identification
