#include "session/bag_name.h"

#include <algorithm>
#include <filesystem>

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

bool isBelow(const fs::path& path, const fs::path& folder) {
  const auto [end, unused] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end();
}

}  // namespace

std::string resolveBagName(const std::string& directory, const std::string& name,
                           std::uintmax_t max_bytes, const std::string& what) {
  if (directory.empty())
    throw RefusedError("bag '" + name + "': bag names are refused until " + what +
                       " is configured");
  const fs::path relative(name);
  if (name.empty() || relative.is_absolute() ||
      std::find(relative.begin(), relative.end(), "..") != relative.end())
    throw RefusedError("bag '" + name + "': give a name below " + what + ", without '..'");
  std::error_code error;
  const fs::path folder = fs::canonical(directory, error);
  if (error) throw FileError(what + " '" + directory + "': " + error.message());
  const fs::path bag = fs::canonical(folder / relative, error);
  if (error) throw FileError("bag '" + name + "' in " + what + ": " + error.message());
  if (!isBelow(bag, folder))
    throw RefusedError("bag '" + name + "' is a link that leads out of " + what);
  if (!fs::is_regular_file(bag) || bag.extension() != ".bag")
    throw FileError("bag '" + name + "' in " + what + " is no .bag file");
  if (fs::file_size(bag, error) > max_bytes)  // an unknown size is the largest number
    throw RefusedError("bag '" + name + "' has more than " + std::to_string(max_bytes) +
                       " bytes (limits.max_bag_size); split it, or read it with identify");
  return bag.string();
}

}  // namespace uncertainty_identification
