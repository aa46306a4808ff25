#include "uncertainty_identification/version.h"

namespace uncertainty_identification {

std::string version() { return PACKAGE_VERSION; }

}  // namespace uncertainty_identification
