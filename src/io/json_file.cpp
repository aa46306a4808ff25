#include "io/json_file.h"

#include "io/atomic_file.h"
#include "io/read_file.h"

namespace uncertainty_identification {

void saveJson(const std::string& path, const nlohmann::json& json) {
  // Ids come from users: one that is not UTF-8 must not prevent the result from being saved.
  writeFileAtomically(path,
                      json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

nlohmann::json loadJson(const std::string& path) {
  try {
    return nlohmann::json::parse(readFile(path));
  } catch (const nlohmann::json::exception& error) {  // of its syntax, or of a number's size
    throw ConfigurationError(path + ": not JSON, or truncated: " + error.what());
  }
}

}  // namespace uncertainty_identification
