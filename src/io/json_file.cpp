#include "io/json_file.h"

#include "io/atomic_file.h"
#include "io/read_file.h"

namespace uncertainty_identification {

namespace {

/// The text with each list of numbers in one line: a line for each would make up half of a file of
/// bounds. Strings hold no line breaks, because JSON escapes them.
std::string withListsInOneLine(const std::string& indented) {
  const auto isNumber = [](char c) { return c == '-' || (c >= '0' && c <= '9') || c == 'n'; };
  std::string text;
  text.reserve(indented.size());
  for (std::size_t at = 0; at < indented.size(); ++at) {
    const std::size_t next = indented.find_first_not_of(" \n", at);
    const bool breaks = indented[at] == '\n' && next != std::string::npos && !text.empty();
    const bool begins =
        breaks && isNumber(indented[next]) && (text.back() == '[' || text.back() == ',');
    const bool ends =
        breaks && indented[next] == ']' && (isNumber(text.back()) || text.back() == 'l');
    if (begins || ends) {
      at = next;
    }
    text += indented[at];
  }
  return text;
}

}  // namespace

void saveJson(const std::string& path, const nlohmann::json& json) {
  // Ids come from users: one that is not UTF-8 must not prevent the result from being saved.
  const std::string text = json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace);
  writeFileAtomically(path, withListsInOneLine(text) + "\n");
}

nlohmann::json loadJson(const std::string& path) {
  try {
    return nlohmann::json::parse(readFile(path));
  } catch (const nlohmann::json::exception& error) {  // of its syntax, or of a number's size
    throw ConfigurationError(path + ": not JSON, or truncated: " + error.what());
  }
}

}  // namespace uncertainty_identification
