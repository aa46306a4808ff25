#include "session/checked_json.h"

#include "io/atomic_file.h"
#include "io/checksum.h"
#include "io/read_file.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

constexpr const char* kKey = "checksum";

std::string text(const json& tree, int indent) {
  return tree.dump(indent, ' ', false, json::error_handler_t::replace);
}

/// Does not depend on how the text is laid out.
std::uint32_t checksumOf(const json& tree) {
  const std::string plain = text(tree, -1);
  return uncertainty_identification::checksumOf(plain.data(), plain.size());
}

}  // namespace

void saveChecked(const std::string& path, json tree) {
  tree[kKey] = checksumOf(tree);
  writeFileAtomically(path, text(tree, 1) + "\n");
}

json loadChecked(const std::string& path) {
  json tree = json::parse(readFile(path));
  if (!tree.is_object() || !tree.contains(kKey)) return tree;
  const json stated = tree[kKey];
  tree.erase(kKey);
  if (stated != checksumOf(tree))
    throw FileError("'" + path +
                    "' does not match its checksum: it was changed after it was written");
  return tree;
}

}  // namespace uncertainty_identification
