#include "session/saved_experiments.h"

#include <filesystem>
#include <set>
#include <utility>

#include "data/check.h"
#include "session/bag_name.h"
#include "session/file_name.h"
#include "session/mebibytes.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolder = "saved/ in store_directory";  // as messages call it

}  // namespace

SavedExperiments::SavedExperiments(const std::string& store_directory, ExperimentFiles files,
                                   const LimitOptions& limits, IdentificationWorker& worker)
    : directory_(store_directory.empty() ? "" : store_directory + "/saved"),
      files_(std::move(files)),
      limits_(limits),
      worker_(worker) {}

/// The path of a file of this name, which does not exist yet. Creates the folder if necessary.
std::string SavedExperiments::newFile(const std::string& name) const {
  if (directory_.empty())
    throw RefusedError("experiments are not saved until store_directory is configured");
  if (!isPlainFileName(name, ".bag"))
    throw RefusedError("name: found '" + name +
                       "'; allowed: letters, digits, '.', '_' and '-', ending in .bag, without a "
                       "folder");
  std::error_code error;
  fs::create_directory(directory_, error);
  if (error) throw FileError("cannot create '" + directory_ + "': " + error.message());
  const std::string path = directory_ + "/" + name;
  if (fs::exists(fs::symlink_status(path)))
    throw RefusedError("name: there is a '" + name + "' already; choose another name");
  if (std::distance(fs::directory_iterator(directory_), {}) >= limits_.max_saved_files)
    throw RefusedError("there are " + std::to_string(limits_.max_saved_files) + " files in " +
                       kFolder + " already; remove some, or raise limits.max_saved_files");
  return path;
}

SavedExperiments::Saved SavedExperiments::save(const std::string& name,
                                               const WriteExperiments& write) const {
  const std::string path = newFile(name);
  const WorkerSnapshot snapshot = worker_.snapshot();
  if (snapshot.experiments.empty()) return {};
  std::vector<const Experiment*> experiments;
  for (const auto& experiment : snapshot.experiments) experiments.push_back(&experiment);
  write(path, experiments);
  return {path, static_cast<int>(experiments.size())};
}

SavedExperiments::Loaded SavedExperiments::load(const std::string& name) {
  if (directory_.empty())
    throw RefusedError("experiments are not loaded until store_directory is configured");
  const std::uint64_t max_bytes = mebibytes(limits_.max_bag_size);
  const std::string path = resolveBagName(directory_, name, max_bytes, kFolder);
  if (files_.unpacked_size(path) > max_bytes)
    throw RefusedError("bag '" + name + "' unpacks to more than " +
                       std::to_string(limits_.max_bag_size) + " MiB (limits.max_bag_size)");
  LoadedData data = files_.read(path);
  if (data.experiments.empty()) throw DataError("bag '" + name + "' holds no experiments");
  std::set<std::string> known;
  for (const auto& own : worker_.snapshot().experiments) known.insert(dataFingerprint({own}));
  Loaded loaded;
  for (auto& experiment : data.experiments) {
    const bool added =
        known.insert(dataFingerprint({experiment})).second && worker_.readmit(experiment);
    ++(added ? loaded.added : loaded.known);
    if (added) worker_.add(std::move(experiment));
  }
  return loaded;
}

}  // namespace uncertainty_identification
