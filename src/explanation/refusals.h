#pragma once

#include <map>
#include <string>
#include <vector>

#include "explanation/fitted_effect.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// The effects that raise the likelihood, and that held-out experiments speak against.
class Refusals {
 public:
  /// Whether held-out experiments speak against a candidate: they are simulated worse with it, or a
  /// candidate that was refused describes far more, of which this one may only take up a part, and
  /// its gain is not clear.
  bool isDue(const FittedEffect& candidate, const Gain& gain,
             const std::vector<FittedEffect>& ranked) const;

  void add(const Effect& effect, const Gain& gain);
  void remove(const Effect& effect) { fits_.erase(effect.label()); }

  /// The candidates that were not refused, in their order.
  std::vector<FittedEffect> left(std::vector<FittedEffect> ranked) const;

  /// A sentence for each refused effect whose label is not among those of the causes.
  std::vector<std::string> warnings(const std::vector<std::string>& causes) const;

 private:
  bool has(const Effect& effect) const { return fits_.count(effect.label()) > 0; }

  std::map<std::string, Comparison> fits_;  ///< [%] without and with the effect, by its label
};

}  // namespace uncertainty_identification
