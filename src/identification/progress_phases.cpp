#include "identification/progress_phases.h"

#include <algorithm>
#include <array>

namespace uncertainty_identification {
namespace {

struct NamedPhase {
  const char* name;
  double weight;  ///< share of the whole identification; all add up to 1
};

/// In the order of Phase.
constexpr std::array<NamedPhase, 8> kPhases{{{"checking the data", 0.02},
                                             {"choosing orders", 0.30},
                                             {"fitting the simulation", 0.05},
                                             {"choosing the error model", 0.35},
                                             {"starting values", 0.06},
                                             {"choosing components", 0.03},
                                             {"optimising", 0.15},
                                             {"standard errors", 0.04}}};

}  // namespace

bool ProgressPhases::report(Phase phase, double share, std::optional<double> log_likelihood) {
  const auto current = static_cast<std::size_t>(phase);
  double before = 0;
  for (std::size_t k = 0; k < current; ++k) before += kPhases[k].weight;
  fraction_ = std::clamp(before + share * kPhases[current].weight, fraction_, 1.0);
  if (callback_ && !callback_({kPhases[current].name, fraction_, log_likelihood}))
    cancelled_ = true;
  return !cancelled_;
}

}  // namespace uncertainty_identification
