#pragma once

#include <optional>
#include <string>

#include "uncertainty_identification/enum_names.h"

/// Effects on the noise v = C/D w, for a truth to hide.
namespace uncertainty_identification {

/// The denominator is D (1 + d1 q^-1 + d2 q^-2).
struct ColourTruth {
  double d1 = -0.5, d2 = 0;  ///< roots inside the unit circle
};

/// w is Student's t, scaled to the same variance.
struct TailsTruth {
  double degrees_of_freedom = 4;  ///< above 2
};

enum class HeteroDriver { input, output };
const EnumNames<HeteroDriver>& enumNames(HeteroDriver);

/// The variance of w is multiplied by 1 - share + share (driver/scale)^2.
struct HeteroTruth {
  double share = 0.5;                         ///< at least 0, below 1
  HeteroDriver driver = HeteroDriver::input;  ///< the recorded u, or x, the plant's output
  double scale = 1;  ///< [unit of the driver], above 0; the driver's standard deviation keeps the
                     ///< mean variance
};

/// The standard deviation of w is multiplied by `ratio` from `start` on.
struct NoiseStepTruth {
  double ratio = 2;    ///< above 0
  double start = 150;  ///< [samples] since the experiment began
};

struct NoiseEffects {
  std::optional<ColourTruth> colour;
  std::optional<TailsTruth> tails;
  std::optional<HeteroTruth> hetero;
  std::optional<NoiseStepTruth> step;

  void validate() const;
};

}  // namespace uncertainty_identification
