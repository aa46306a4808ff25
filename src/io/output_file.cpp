#include "io/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

namespace fs = std::filesystem;

void requireWritable(const std::string& path) {
  std::error_code ignored;
  if (path.empty()) throw FileError("the name of the output file is empty");
  if (fs::is_directory(path, ignored))
    throw FileError(path + ": is a folder; give the name of a file");
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (!fs::is_directory(folder, ignored)) {
    throw FileError(path + ": cannot be written: there is no folder " + folder);
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw FileError(path + ": cannot be written: " + folder + ": " + std::strerror(errno));
  }
}

void makeEmptyFolder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw FileError(path + ": the folder cannot be created: " + error.message());
  const bool empty = fs::is_empty(path, error);
  if (error) throw FileError(path + ": the folder cannot be read: " + error.message());
  if (!empty) throw FileError(path + ": the folder is not empty; name a new or an empty one");
}

}  // namespace uncertainty_identification
