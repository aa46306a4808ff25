#pragma once

#include <string>

namespace uncertainty_identification {

/// The package's version, e.g. "0.1.0": results carry it.
std::string version();

}  // namespace uncertainty_identification
