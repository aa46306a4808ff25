#pragma once

#include <string>
#include <vector>

namespace uncertainty_identification {

/// Throws FileError, with the reason, when a file of this name cannot be written. Programs call it
/// before a long computation, so that its result is not lost. Refuses also a file that is one of
/// the `inputs`, or a data file (.csv, .tsv, .bag) in a folder among them: by device and inode, so
/// that no link or other spelling hides it.
void requireWritable(const std::string& path, const std::vector<std::string>& inputs = {});

/// Throws FileError when two of the outputs of a program are the same file, of which one would
/// replace the other. Devices and pipes may be named twice.
void requireDistinct(const std::vector<std::string>& outputs);

/// Creates a folder unless it exists. Throws FileError when it cannot be created or is not empty.
void makeEmptyFolder(const std::string& path);

}  // namespace uncertainty_identification
