#include "ros/saved_experiments.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "data/experiment_checks.h"
#include "ros/bag_name.h"
#include "ros/experiment_bag.h"
#include "ros/file_name.h"
#include "ros/mebibytes.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/ros/bag_reader.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;
using Save = messages::Save::Response;
using Load = messages::Load::Response;

constexpr const char* kFolder = "saved/ in store_directory";

/// Where a bag of this name goes. Throws RefusedError, or FileError as the system does.
std::string newFile(const std::string& directory, const std::string& name, int most) {
  if (directory.empty())
    throw RefusedError("experiments are not saved until store_directory is configured");
  if (!isPlainFileName(name, ".bag"))
    throw RefusedError("name: found '" + name +
                       "'; allowed: letters, digits, '.', '_' and '-', ending in .bag, without a "
                       "folder");
  std::error_code error;
  fs::create_directory(directory, error);
  if (error) throw FileError("cannot create '" + directory + "': " + error.message());
  const std::string path = directory + "/" + name;
  if (fs::exists(fs::symlink_status(path)))
    throw RefusedError("name: there is a '" + name + "' already; choose another name");
  if (std::distance(fs::directory_iterator(directory), {}) >= most)
    throw RefusedError("there are " + std::to_string(most) + " files in " + kFolder +
                       " already; remove some, or raise limits.max_saved_files");
  return path;
}

template <typename Response>
Response answerOf(std::uint8_t code, const std::string& message) {
  Response response;
  response.code = code;
  response.message = message;
  return response;
}

}  // namespace

SavedExperiments::SavedExperiments(const std::string& store_directory, const LimitOptions& limits,
                                   IdentificationWorker& worker)
    : directory_(store_directory.empty() ? "" : store_directory + "/saved"),
      limits_(limits),
      worker_(worker) {}

Save SavedExperiments::save(const messages::Save::Request& request,
                            const std::optional<messages::IdentificationResult>& result) const {
  try {
    const std::string path = newFile(directory_, request.name, limits_.max_saved_files);
    const WorkerSnapshot snapshot = worker_.snapshot();
    if (snapshot.experiments.empty())
      return answerOf<Save>(Save::NONE_YET, "there are no experiments to save yet");
    std::vector<const Experiment*> experiments;
    for (const auto& experiment : snapshot.experiments) experiments.push_back(&experiment);
    writeExperimentBag(path, experiments, result ? &*result : nullptr);
    auto response =
        answerOf<Save>(Save::OK, std::to_string(experiments.size()) + " experiments were saved");
    response.path = path;
    response.experiments = static_cast<std::uint32_t>(experiments.size());
    return response;
  } catch (const RefusedError& error) {
    return answerOf<Save>(Save::REFUSED, error.what());
  } catch (const std::exception& error) {
    return answerOf<Save>(Save::FILE_ERROR, error.what());
  }
}

Load SavedExperiments::load(const messages::Load::Request& request) {
  try {
    if (directory_.empty())
      throw RefusedError("experiments are not loaded until store_directory is configured");
    const std::string path =
        resolveBagName(directory_, request.name, mebibytes(limits_.max_bag_size), kFolder);
    if (unpackedSize(path) > mebibytes(limits_.max_bag_size))
      throw RefusedError("bag '" + request.name + "' unpacks to more than " +
                         std::to_string(limits_.max_bag_size) + " MiB (limits.max_bag_size)");
    LoadedData data = readExperimentBag(path);
    if (data.experiments.empty())
      return answerOf<Load>(Load::DATA_ERROR, "bag '" + request.name + "' holds no experiments");
    std::set<std::string> known;
    for (const auto& own : worker_.snapshot().experiments) known.insert(dataFingerprint({own}));
    Load response;
    for (auto& experiment : data.experiments) {
      const bool added =
          known.insert(dataFingerprint({experiment})).second && worker_.readmit(experiment);
      ++(added ? response.added : response.known);
      if (added) worker_.add(std::move(experiment));
    }
    response.message = std::to_string(response.added) + " experiments were added, " +
                       std::to_string(response.known) + " were there already";
    return response;
  } catch (const RefusedError& error) {
    return answerOf<Load>(Load::REFUSED, error.what());
  } catch (const std::exception& error) {
    return answerOf<Load>(Load::FILE_ERROR, error.what());
  }
}

}  // namespace uncertainty_identification
