#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "io/atomic_file.h"
#include "io/read_file.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

/// Writes a JSON file, all of it or nothing. Throws FileError.
inline void saveJson(const std::string& path, const nlohmann::json& json) {
  // Ids come from users: what is not UTF-8 in them must not cost the result.
  writeFileAtomically(path,
                      json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

/// What `parse` makes of a JSON file; the file's name starts the message of every
/// ConfigurationError. Throws FileError when it cannot be read, ConfigurationError when it is not
/// JSON.
template <class Parse>
auto loadJsonAs(const std::string& path, const Parse& parse) {
  const std::string content = readFile(path);
  try {
    return parse(nlohmann::json::parse(content));
  } catch (const nlohmann::json::parse_error& error) {
    throw ConfigurationError(path + ": not JSON, or truncated: " + error.what());
  } catch (const ConfigurationError& error) {
    throw ConfigurationError(path + ": " + error.what());
  }
}

}  // namespace uncertainty_identification
