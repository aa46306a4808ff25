#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "data/experiment_checks.h"
#include "io/atomic_file.h"
#include "session/checked_json.h"
#include "session/experiment_store.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/configuration_yaml.h"

/// Reads what a store holds, and repairs what a crash or a bad disk left incomplete.
namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The files of a folder that are named <prefix><number><suffix>, ordered by number.
std::map<std::uint64_t, fs::path> numbered(const std::string& folder, const std::string& prefix,
                                           const std::string& suffix) {
  std::map<std::uint64_t, fs::path> files;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename();
    if (name.size() <= prefix.size() + suffix.size() || name.compare(0, prefix.size(), prefix) != 0)
      continue;
    char* end = nullptr;
    const std::uint64_t number = std::strtoull(name.c_str() + prefix.size(), &end, 10);
    if (end == suffix && number > 0) files[number] = entry.path();
  }
  return files;
}

void removeTemporary(const std::string& folder) {
  std::error_code ignored;  // a temporary file that stays does no harm
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().string().find(".tmp.") != std::string::npos) fs::remove(entry, ignored);
}

RejectedExperiment readRejected(const std::string& path) {
  const json tree = loadChecked(path);
  return {tree.at("id"), tree.at("reason")};
}

StoredConfiguration readConfiguration(const std::string& path) {
  const json tree = loadChecked(path);
  return {configurationFromJson(tree.at("configuration")),
          configurationFromJson(tree.at("parameters"))};
}

/// A path in the folder that is not in use yet: `name`, or with ".2", ".3", ... appended.
std::string freeName(const std::string& folder, const std::string& name) {
  std::string free = folder + "/" + name;
  for (int number = 2; fs::exists(free); ++number)
    free = folder + "/" + name + "." + std::to_string(number);
  return free;
}

}  // namespace

StoredState ExperimentStore::load(const LimitOptions& limits) {
  for (const auto& folder : {directory_, current_, current_ + "/rejected"}) removeTemporary(folder);
  StoredState state;
  finishRejections();
  loadExperiments(limits, state);
  loadRejected(limits.max_experiments, state);
  const auto attempt = [&](const std::string& path, const auto& read) {
    if (!fs::exists(path)) return;
    try {
      read(path);
    } catch (const std::exception& error) {
      moveDamaged(path, error.what(), state);
    }
  };
  attempt(current_ + "/result.json",
          [&](const std::string& path) { state.result = loadStoredResult(path); });
  attempt(directory_ + "/configuration.json",
          [&](const std::string& path) { state.configuration = readConfiguration(path); });
  return state;
}

void ExperimentStore::loadExperiments(const LimitOptions& limits, StoredState& state) {
  const auto files = numbered(current_, "experiment_", ".bag");
  state.count = static_cast<int>(files.size());
  if (!files.empty()) state.last_number = files.rbegin()->first;
  const auto rejected = numbered(current_ + "/rejected", "experiment_", ".bag");
  if (!rejected.empty()) state.last_number = std::max(state.last_number, rejected.rbegin()->first);
  const int max_count = std::max(1, limits.max_experiments);
  int usable = 0, unusable = 0;
  for (auto file = files.rbegin(); file != files.rend(); ++file) {
    if (usable >= max_count || unusable >= max_count) break;
    try {
      auto experiment = std::make_shared<const Experiment>(readOne(file->second));
      ++(defectOf(*experiment, limits).empty() ? usable : unusable);
      state.kept.push_back({file->first, std::move(experiment)});
    } catch (const std::exception& error) {
      moveDamaged(file->second, error.what(), state);
      --state.count;
    }
  }
  std::reverse(state.kept.begin(), state.kept.end());
}

/// Throws FileError and DataError when the file does not hold exactly one experiment.
Experiment ExperimentStore::readOne(const std::string& path) const {
  LoadedData data = files_.read(path);
  if (!data.rejected.empty()) throw DataError(data.rejected.front().reason);
  if (data.experiments.size() != 1)
    throw DataError("it holds " + std::to_string(data.experiments.size()) +
                    " experiments instead of one");
  return std::move(data.experiments.front());
}

void ExperimentStore::loadRejected(int max_count, StoredState& state) {
  const std::string folder = current_ + "/rejected";
  const auto without_samples = numbered(folder, "without_samples_", ".json");
  if (!without_samples.empty()) last_rejection_ = without_samples.rbegin()->first;
  for (const auto& files : {without_samples, numbered(folder, "experiment_", ".bag.json")}) {
    auto file = files.begin();
    std::advance(file, std::max(0, static_cast<int>(files.size()) - std::max(1, max_count)));
    for (; file != files.end(); ++file) {
      try {
        state.rejected.push_back(readRejected(file->second));
      } catch (const std::exception& error) {
        moveDamaged(file->second, error.what(), state);
      }
    }
  }
}

/// Moves experiments whose rejection was interrupted by a crash: their reason was written already.
void ExperimentStore::finishRejections() {
  for (const auto& [number, file] : numbered(current_ + "/rejected", "experiment_", ".bag.json")) {
    const std::string from = current_ + "/" + fileName(number);
    if (fs::exists(from)) renameDurably(from, current_ + "/rejected/" + fileName(number));
  }
}

void ExperimentStore::moveDamaged(const std::string& path, const std::string& reason,
                                  StoredState& state) {
  const std::string folder = current_ + "/damaged", file = fs::path(path).filename();
  try {
    fs::create_directories(folder);
    const std::string to = freeName(folder, file);
    renameDurably(path, to);
    writeFileAtomically(to + ".txt", reason + "\n");
    state.warnings.push_back("'" + path + "' is damaged and was moved to '" + to + "': " + reason);
  } catch (const std::exception& error) {
    state.warnings.push_back("'" + path + "' is damaged (" + reason +
                             ") and could not be moved aside: " + error.what());
  }
}

}  // namespace uncertainty_identification
