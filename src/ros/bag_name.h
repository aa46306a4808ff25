#pragma once

#include <cstdint>
#include <string>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

/// A request that is not allowed, as against one that fails.
class RefusedError : public Error {
 public:
  using Error::Error;
};

/// The bag that a name in a request means: a .bag file below `directory`, which messages call
/// `what`. Throws RefusedError when the directory is empty (bag names are not allowed), the name is
/// absolute, contains "..", leads out of the directory through a link, or means a file of more than
/// `most` bytes; FileError when there is no such bag.
std::string resolveBagName(const std::string& directory, const std::string& name,
                           std::uintmax_t most, const std::string& what = "bag_directory");

}  // namespace uncertainty_identification
