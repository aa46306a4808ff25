#pragma once

#include <string>

namespace uncertainty_identification {

/// Throws FileError, with the reason, when a file of this name could not be written: to be asked
/// before hours of work.
void requireWritable(const std::string& path);

/// Creates a folder, if need be, that holds nothing yet, so that what is written there is all there
/// is. Throws FileError when it cannot be created or holds something.
void makeEmptyFolder(const std::string& path);

}  // namespace uncertainty_identification
