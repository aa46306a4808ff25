#include "simulation/effects_truth.h"

#include "configuration/require.h"
#include "math/polynomial.h"

namespace uncertainty_identification {

const EnumNames<HeteroDriver>& enumNames(HeteroDriver) {
  static const EnumNames<HeteroDriver> kNames{{HeteroDriver::input, "u"},
                                              {HeteroDriver::output, "x"}};
  return kNames;
}

bool EffectsTruth::feedsBack() const {
  return plant.cubic || plant.coulomb || unnamed.bilinear || unnamed.gravity || unnamed.outflow;
}

void EffectsTruth::validate() const {
  EffectsTruth copy = *this;  // forEach() also serves the reader of YAML, so it is not const
  copy.forEach([](const std::string& name, const auto& effect) {
    if (effect) checkFields("effects." + name, *effect);
  });
  if (noise.colour) {
    const Eigen::VectorXd d = Eigen::Vector2d(noise.colour->d1, noise.colour->d2);
    require(isStable(d), "effects.noise_colour", d.transpose(),
            "d1, d2 with the roots of 1 + d1 q^-1 + d2 q^-2 inside the unit circle");
  }
}

}  // namespace uncertainty_identification
