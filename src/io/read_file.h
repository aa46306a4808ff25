#pragma once

#include <string>

namespace uncertainty_identification {

/// The whole content of a file. Throws FileError, with the system's reason, when it cannot be read.
std::string readFile(const std::string& path);

}  // namespace uncertainty_identification
