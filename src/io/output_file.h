#pragma once

#include <string>

namespace uncertainty_identification {

/// Throws FileError, with the reason, when a file of this name cannot be written. Programs call it
/// before a long computation, so that its result is not lost.
void requireWritable(const std::string& path);

/// Creates a folder unless it exists. Throws FileError when it cannot be created or is not empty.
void makeEmptyFolder(const std::string& path);

}  // namespace uncertainty_identification
