#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// JSON files of a node's store. Each holds a checksum of its contents, because a changed digit
/// would otherwise be read as if nothing had happened.
namespace uncertainty_identification {

/// Writes the object with the key `checksum` added. The file appears complete and on the disk, or
/// not at all. Bytes of texts that are not UTF-8 are replaced. Throws FileError.
void saveChecked(const std::string& path, nlohmann::json tree);

/// Reads the object, without its checksum. Files of earlier versions have none and are accepted.
/// Throws FileError when the file cannot be read or does not match its checksum, and
/// nlohmann::json::exception when it is not JSON.
nlohmann::json loadChecked(const std::string& path);

}  // namespace uncertainty_identification
