#include "session/experiment_store.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "io/atomic_file.h"
#include "session/checked_json.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"

/// The functions that write. Those that read are in experiment_store_load.cpp.
namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

/// Creates this folder but not its parents: when the disk is not mounted, nothing may be written to
/// the mount point.
void createFolder(const std::string& path) {
  std::error_code error;
  fs::create_directory(path, error);
  if (error) throw FileError("cannot create '" + path + "': " + error.message());
}

int lockFolder(const std::string& directory) {
  std::error_code error;
  fs::create_directories(directory, error);
  const int lock = ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock < 0) {
    throw ConfigurationError("store_directory: '" + directory + "': " + std::strerror(errno) +
                             "; name a folder that the node may write to");
  }
  if (::flock(lock, LOCK_EX | LOCK_NB) == 0) return lock;
  const int reason = errno;
  ::close(lock);
  throw ConfigurationError(
      "store_directory: '" + directory + "': " +
      (reason == EWOULDBLOCK ? "another node uses it; give each its own" : std::strerror(reason)));
}

}  // namespace

ExperimentStore::ExperimentStore(const std::string& directory, ExperimentFiles files)
    : directory_(directory),
      current_(directory + "/current"),
      files_(std::move(files)),
      lock_(lockFolder(directory)) {}

ExperimentStore::~ExperimentStore() { ::close(lock_); }

std::string ExperimentStore::fileName(std::uint64_t number) const {
  constexpr std::size_t kDigits = 8;
  const std::string digits = std::to_string(number);
  return "experiment_" + std::string(kDigits - std::min(kDigits, digits.size()), '0') + digits +
         ".bag";
}

void ExperimentStore::write(const KeptExperiment& kept) {
  createFolder(current_);
  files_.write(current_ + "/" + fileName(kept.number), {kept.experiment.get()});
}

void ExperimentStore::write(const StoredResult& result) {
  createFolder(current_);
  saveStoredResult(current_ + "/result.json", result);
}

void ExperimentStore::write(const StoredConfiguration& stored) {
  saveChecked(directory_ + "/configuration.json", {{"configuration", toJson(stored.configuration)},
                                                   {"parameters", toJson(stored.parameters)}});
}

// The reason is written before the experiment is moved. If the node dies in between, load() finds
// the reason and moves the experiment (finishRejections).
void ExperimentStore::reject(std::uint64_t number, const RejectedExperiment& rejected) {
  createFolder(current_);
  createFolder(current_ + "/rejected");
  const std::string file = current_ + "/rejected/" + fileName(number);
  saveChecked(file + ".json", {{"id", rejected.id}, {"reason", rejected.reason}});
  if (!fs::exists(file)) renameDurably(current_ + "/" + fileName(number), file);
}

void ExperimentStore::reject(const RejectedExperiment& rejected, int max_count) {
  createFolder(current_);
  const std::string folder = current_ + "/rejected";
  createFolder(folder);
  const auto name = [&](std::uint64_t number) {
    return folder + "/without_samples_" + std::to_string(number) + ".json";
  };
  saveChecked(name(last_rejection_ + 1), {{"id", rejected.id}, {"reason", rejected.reason}});
  const auto kept = static_cast<std::uint64_t>(std::max(1, max_count));
  if (++last_rejection_ > kept) ::unlink(name(last_rejection_ - kept).c_str());
}

void ExperimentStore::reset() {
  last_rejection_ = 0;
  if (!fs::exists(current_)) return;
  int number = 1;
  const auto name = [&] { return directory_ + "/reset_" + std::to_string(number); };
  while (fs::exists(name())) ++number;
  renameDurably(current_, name());
}

}  // namespace uncertainty_identification
