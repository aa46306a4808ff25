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

/// Share of a time limit after which the search for a better model ends, so that the standard
/// errors and tests of the best one can still be computed.
constexpr double kForSearch = 0.75;

}  // namespace

bool ProgressPhases::report(Phase phase, double share, std::optional<double> log_likelihood) {
  const auto current = static_cast<std::size_t>(phase);
  double before = 0;
  for (std::size_t k = 0; k < current; ++k) before += kPhases[k].weight;
  const double fraction = before + share * kPhases[current].weight;
  last_ = {kPhases[current].name, std::clamp(fraction, last_.fraction, 1.0), log_likelihood};
  call();
  return !searchEnds();
}

void ProgressPhases::call() {
  if (!cancelled_ && callback_ && !callback_(last_)) cancelled_ = true;
}

bool ProgressPhases::mustEnd() {
  call();
  return cancelled_ || isOver(1);
}

bool ProgressPhases::searchEnds() const { return cancelled_ || isOver(kForSearch); }

bool ProgressPhases::allowsAnother() const { return !cancelled_ && !isOver(kForSearch / 2); }

bool ProgressPhases::isOver(double share_of_time) const {
  return time_limit_ > 0 && watch_.seconds() > share_of_time * time_limit_;
}

}  // namespace uncertainty_identification
