#pragma once

#include <optional>

#include "explanation/search.h"

namespace uncertainty_identification {

/// What causes gain on the last third of each record, the models with and without them having been
/// fitted to the rest.
struct LastThirds {
  double log_density = 0;  ///< [nats] gain, given the first two thirds
  double first = 0;        ///< [nats] gain on these: where they do not show a cause, its parameters
                           ///< stay as the last third has made them
  double error_ratio = 1;  ///< squared error of the simulation, with over without
};

/// Of all causes that were found together; nullopt where there are none or experiments are held
/// out, where the models cannot be fitted to the first two thirds, or time does not allow it.
/// Records are masked and not cut, so that what depends on the time within a record means the same.
std::optional<LastThirds> gainOnLastThirds(const SearchState& base, const SearchState& found,
                                           const FitContext& context);

}  // namespace uncertainty_identification
