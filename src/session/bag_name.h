#pragma once

#include <cstdint>
#include <string>

#include "session/refused_error.h"

namespace uncertainty_identification {

/// Returns the full path of the .bag file that a request names relative to `directory`. Messages of
/// errors call that directory `what`.
///
/// Throws RefusedError when `directory` is empty (bag names are not allowed then), when the name is
/// empty, absolute, contains ".." or leads out of the directory through a link, and when the file
/// has more than `max_bytes` bytes. Throws FileError when there is no such bag.
std::string resolveBagName(const std::string& directory, const std::string& name,
                           std::uintmax_t max_bytes, const std::string& what = "bag_directory");

}  // namespace uncertainty_identification
