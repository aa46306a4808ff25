#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

/// Writes a JSON file, all of it or nothing, each list of numbers in one line; bytes that are not
/// UTF-8 are replaced. Throws FileError.
void saveJson(const std::string& path, const nlohmann::json& json);

/// Throws FileError when the file cannot be read, ConfigurationError when it is not JSON.
nlohmann::json loadJson(const std::string& path);

/// What `parse` makes of a JSON file; the file's name starts the message of every
/// ConfigurationError. Throws as loadJson() does.
template <class Parse>
auto loadJsonAs(const std::string& path, const Parse& parse) {
  const nlohmann::json json = loadJson(path);
  try {
    return parse(json);
  } catch (const ConfigurationError& error) {
    throw ConfigurationError(path + ": " + error.what());
  }
}

}  // namespace uncertainty_identification
