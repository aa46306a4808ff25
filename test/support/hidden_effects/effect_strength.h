#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/truth.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification::test {

/// Measures how strong an effect is, as randomHiddenEffect() defines it. The truth without the
/// effect is simulated once, with the same seed. The strength is infinite when the output diverges
/// or when a closed loop makes the variance of the input more than three times as large.
class EffectStrength {
 public:
  EffectStrength(std::string name, const Truth& without, std::uint64_t seed);

  /// The strength of the effect in `with`, which is the truth without it plus the effect.
  double operator()(const Truth& with) const;

 private:
  double outputShare(const Truth& with) const;
  double loopCorrelation(const Truth& with) const;
  double varianceGain(const Truth& with) const;

  std::string name_;
  std::uint64_t seed_;
  std::vector<Experiment> without_;
  double output_variance_ = 0;  ///< of the noise-free output
  double input_variance_ = 0;
};

}  // namespace uncertainty_identification::test
