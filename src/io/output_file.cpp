#include "io/output_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "io/atomic_file.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

namespace fs = std::filesystem;

namespace {

/// Whether both name the same file, also through links. A file that does not exist yet is compared
/// by its path.
bool isSameFile(const fs::path& left, const fs::path& right) {
  std::error_code ignored;
  if (fs::exists(left, ignored) || fs::exists(right, ignored))
    return fs::equivalent(left, right, ignored);
  return fs::weakly_canonical(left, ignored) == fs::weakly_canonical(right, ignored);
}

bool isData(const fs::path& path) {
  return path.extension() == ".csv" || path.extension() == ".tsv" || path.extension() == ".bag";
}

void requireOther(const std::string& path, const std::string& input) {
  std::error_code ignored;
  const auto refuse = [&path](const std::string& of) {
    throw FileError(path + ": is to be written and is also read (" + of +
                    "); name another output file");
  };
  if (isSameFile(path, input)) refuse(input);
  if (!fs::is_directory(input, ignored)) return;
  for (const auto& entry : fs::directory_iterator(input, ignored))
    if (isData(entry.path()) && isSameFile(path, entry.path())) refuse(entry.path().string());
}

}  // namespace

void requireWritable(const std::string& path, const std::vector<std::string>& inputs) {
  std::error_code ignored;
  if (path.empty()) throw FileError("the name of the output file is empty");
  if (fs::is_directory(path, ignored))
    throw FileError(path + ": is a folder; give the name of a file");
  for (const std::string& input : inputs) requireOther(path, input);
  if (isDeviceOrPipe(path)) {
    if (access(path.c_str(), W_OK) != 0)
      throw FileError(path + ": cannot be written: " + std::strerror(errno));
    return;
  }
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (!fs::is_directory(folder, ignored)) {
    throw FileError(path + ": cannot be written: there is no folder " + folder);
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) {
    throw FileError(path + ": cannot be written: " + folder + ": " + std::strerror(errno));
  }
}

void requireDistinct(const std::vector<std::string>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!isDeviceOrPipe(outputs[i]) && isSameFile(outputs[i], outputs[j]))
        throw FileError(outputs[i] +
                        ": is named for two outputs, of which one would replace the other; name "
                        "two files");
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
