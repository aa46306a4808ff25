#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/simulation/truth.h"

namespace uncertainty_identification::test {

/// How strong the named effect in `with` is, as randomHiddenEffect() measures it; `without` is the
/// same truth without it, its experiments simulated with the same seed. Infinite where the output
/// diverges or a closed loop more than triples the input's variance. exp_feedback: the correlation
/// of an innovation with the next input.
class EffectStrength {
 public:
  EffectStrength(std::string name, const Truth& without, std::uint64_t seed);

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
