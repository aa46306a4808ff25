#include "fmu/unpacked_fmu.h"

#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <vector>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

constexpr zip_uint64_t kMostBytes = zip_uint64_t{2} << 30;  ///< unpacked, in all
const char* const kDescription = "modelDescription.xml";

#if defined(__aarch64__)
const std::vector<std::string> kPlatforms{"aarch64-linux"};
#else
const std::vector<std::string> kPlatforms{"linux64", "x86_64-linux"};
#endif

using ZipArchive = std::unique_ptr<zip_t, void (*)(zip_t*)>;

ZipArchive opened(const std::string& path) {
  int code = 0;
  zip_t* archive = zip_open(path.c_str(), ZIP_RDONLY, &code);
  if (archive) return {archive, zip_discard};
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  throw FileError("cannot be read as an FMU, which is a zip archive: " + reason);
}

/// Whether an entry stays below the folder that it is unpacked into.
bool staysBelow(const fs::path& name) {
  if (name.is_absolute() || name.string().find('\\') != std::string::npos) return false;
  return std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
}

bool isNeeded(const std::string& name) {
  const auto is_below = [&name](const std::string& folder) { return name.rfind(folder, 0) == 0; };
  return name == kDescription || is_below("resources/") ||
         std::any_of(kPlatforms.begin(), kPlatforms.end(), [&](const std::string& platform) {
           return is_below("binaries/" + platform + "/");
         });
}

void copyEntry(zip_t* archive, zip_uint64_t index, const fs::path& target) {
  fs::create_directories(target.parent_path());
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> entry(zip_fopen_index(archive, index, 0),
                                                                zip_fclose);
  std::ofstream file(target, std::ios::binary);
  std::vector<char> buffer(1 << 16);
  zip_int64_t count = 0;
  while (entry && (count = zip_fread(entry.get(), buffer.data(), buffer.size())) > 0)
    file.write(buffer.data(), static_cast<std::streamsize>(count));
  file.close();
  if (!entry || count < 0 || !file)
    throw FileError("its entry " + target.filename().string() +
                    " cannot be unpacked: the archive is damaged, or the disk is full");
}

void unpackAll(const std::string& path, const fs::path& folder) {
  const ZipArchive archive = opened(path);
  zip_uint64_t bytes = 0;
  const auto entries = static_cast<zip_uint64_t>(zip_get_num_entries(archive.get(), 0));
  for (zip_uint64_t k = 0; k < entries; ++k) {
    zip_stat_t entry;
    if (zip_stat_index(archive.get(), k, 0, &entry) != 0) continue;
    const std::string name = entry.name;
    if (!staysBelow(name))
      throw FileError(
          "its entry '" + name +
          "' would lie outside the FMU; do not use this file, and ask where it is from");
    if (!isNeeded(name) || name.back() == '/') continue;
    if (entry.size > kMostBytes - bytes) throw FileError("it unpacks to more than 2 GiB");
    bytes += entry.size;
    copyEntry(archive.get(), k, folder / name);
  }
}

std::string textOfFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

bool readsFmus() { return true; }

UnpackedFmu::UnpackedFmu(const std::string& path) : folder_(path) {
  try {
    if (!fs::is_directory(path)) unpack(path);
    const fs::path description = fs::path(folder_) / kDescription;
    if (!fs::exists(description))
      throw FileError(std::string("it has no ") + kDescription + ", so it is no FMU");
    description_ = parseModelDescription(textOfFile(description));
    library_ = findLibrary();
  } catch (const std::exception& error) {
    removeTemporary();
    throw FileError(path + ": " + error.what());
  }
}

UnpackedFmu::~UnpackedFmu() { removeTemporary(); }

void UnpackedFmu::unpack(const std::string& path) {
  std::string name = (fs::temp_directory_path() / "uncertainty_identification_fmu_XXXXXX").string();
  opened(path);  // before a folder is made
  if (!mkdtemp(name.data())) throw FileError("no temporary folder can be made for it");
  folder_ = name;
  is_temporary_ = true;
  unpackAll(path, folder_);
}

void UnpackedFmu::removeTemporary() {
  std::error_code ignored;
  if (is_temporary_) fs::remove_all(folder_, ignored);
}

std::string UnpackedFmu::findLibrary() const {
  std::string looked;
  for (const std::string& platform : kPlatforms) {
    const fs::path library =
        fs::path(folder_) / "binaries" / platform / (description_.identifier + ".so");
    if (fs::exists(library)) return fs::absolute(library).string();
    looked += (looked.empty() ? "binaries/" : ", binaries/") + platform;
  }
  throw FileError("it has no library " + description_.identifier + ".so for this machine in " +
                  looked + "; export it for Linux");
}

}  // namespace uncertainty_identification
