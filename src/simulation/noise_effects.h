#pragma once

#include <optional>

#include "simulation/field.h"
#include "uncertainty_identification/enum_names.h"

/// Effects on the noise v = C/D w.
namespace uncertainty_identification {

/// Colours the noise further: its denominator is D (1 + d1 q^-1 + d2 q^-2), whose roots must lie
/// inside the unit circle.
struct ColourTruth {
  double d1 = -0.5, d2 = 0;
  Fields fields() { return {{"d1", &d1}, {"d2", &d2}}; }
};

/// w has heavy tails: it is Student's t, scaled to the variance of the Gaussian w.
struct TailsTruth {
  double degrees_of_freedom = 4;
  Fields fields() { return {{"degrees_of_freedom", &degrees_of_freedom, range::kAboveTwo}}; }
};

/// The signal that the variance of the noise follows: the recorded input u or the plant's output x.
enum class HeteroDriver { input, output };
const EnumNames<HeteroDriver>& enumNames(HeteroDriver);

/// The variance of w changes with a signal: it is multiplied by
/// 1 - share + share (driver/scale)^2.
struct HeteroTruth {
  double share = 0.5;
  HeteroDriver driver = HeteroDriver::input;
  double scale =
      1;  ///< [unit of the driver]; the driver's root mean square keeps the mean variance
  Fields fields() {
    return {{"share", &share, range::kBelowOne},
            {"driver", &driver},
            {"scale", &scale, range::kPositive}};
  }
};

/// From the time `start` on the standard deviation of w is multiplied by `ratio`.
struct NoiseStepTruth {
  double ratio = 2;
  double start = 150;  ///< [samples] since the experiment began
  Fields fields() { return {{"ratio", &ratio, range::kPositive}, {"start", &start}}; }
};

/// Each effect is absent or has its parameters.
struct NoiseEffects {
  std::optional<ColourTruth> colour;
  std::optional<TailsTruth> tails;
  std::optional<HeteroTruth> hetero;
  std::optional<NoiseStepTruth> step;
};

}  // namespace uncertainty_identification
