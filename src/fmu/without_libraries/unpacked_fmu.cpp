// In place of unpacked_fmu.cpp where libzip or tinyxml2 was not found.
#include "fmu/unpacked_fmu.h"

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

bool readsFmus() { return false; }

UnpackedFmu::UnpackedFmu(const std::string& /*path*/) {
  throw ConfigurationError(
      "simulation.fmu: this build cannot read functional mock-up units; install libzip-dev and "
      "libtinyxml2-dev, configure and build again");
}

UnpackedFmu::~UnpackedFmu() = default;

}  // namespace uncertainty_identification
