#include "io/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

[[noreturn]] void fail(const std::string& path, int error) {
  throw FileError("cannot write '" + path + "': " + std::strerror(error) +
                  "; check that the folder exists, may be written to and has space left");
}

/// Removes the temporary file unless it was renamed.
class Removal {
 public:
  explicit Removal(const std::string& path) : path_(path) {}
  ~Removal() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  Removal(const Removal&) = delete;
  Removal& operator=(const Removal&) = delete;
  void cancel() { path_.clear(); }

 private:
  std::string path_;
};

std::string folderOf(const std::string& path) {
  const auto slash = path.rfind('/');
  if (slash == std::string::npos) return ".";
  return slash == 0 ? "/" : path.substr(0, slash);
}

std::string temporaryName(const std::string& path) {
  static std::atomic<unsigned> count{0};
  return path + ".tmp." + std::to_string(::getpid()) + "." + std::to_string(count++);
}

void synchronise(const std::string& name, const std::string& path) {
  const int file = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(path, errno);
  const int error = ::fsync(file) == 0 ? 0 : errno;
  ::close(file);
  if (error != 0 && error != EINVAL)
    fail(path, error);  // EINVAL: the file system cannot synchronise
}

}  // namespace

bool isDeviceOrPipe(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::is_other(std::filesystem::status(path, ignored));
}

void writeAtomically(const std::string& name,
                     const std::function<void(const std::string&)>& write) {
  std::error_code ignored;
  if (isDeviceOrPipe(name)) return write(name);
  const std::filesystem::path linked = std::filesystem::canonical(name, ignored);
  const std::string path = linked.empty() ? name : linked.string();
  const std::string temporary = temporaryName(path);
  Removal removal(temporary);
  write(temporary);
  synchronise(temporary, path);
  if (std::rename(temporary.c_str(), path.c_str()) != 0) fail(path, errno);
  removal.cancel();
  synchronise(folderOf(path), path);
}

void renameDurably(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) fail(to, errno);
  synchronise(folderOf(to), to);
  synchronise(folderOf(from), from);
}

void writeFileAtomically(const std::string& path, const std::string& content) {
  writeAtomically(path, [&](const std::string& temporary) {
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (file == nullptr) fail(path, errno);
    const bool written = std::fwrite(content.data(), 1, content.size(), file) == content.size();
    const int error = errno;
    const bool closed = std::fclose(file) == 0;
    if (!written || !closed) fail(path, written ? errno : error);
  });
}

}  // namespace uncertainty_identification
