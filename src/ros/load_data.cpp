#include "uncertainty_identification/ros/load_data.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/csv.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

bool isDataFile(const fs::path& path) {
  return path.extension() == ".bag" || path.extension() == ".csv" || path.extension() == ".tsv";
}

/// Files of columns whose extension says too little to read all such files of a folder.
bool isText(const fs::path& path) {
  return path.extension() == ".txt" || path.extension() == ".dat" || path.extension() == ".log";
}

std::vector<fs::path> filesOf(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) {
    if (!fs::exists(path, error)) throw FileError("'" + path + "' does not exist");
    if (!isDataFile(path) && !isText(path))
      throw FileError("'" + path +
                      "' is not a .bag file, a .csv file (or .tsv, .txt, .dat, .log) or a folder");
    return {path};
  }
  std::vector<fs::path> files;
  for (auto entry = fs::directory_iterator(path, error);
       !error && entry != fs::directory_iterator(); entry.increment(error))
    if (isDataFile(entry->path())) files.push_back(entry->path());
  if (error) throw FileError("cannot read folder '" + path + "': " + error.message());
  if (files.empty()) throw FileError("folder '" + path + "' holds no .bag, .csv or .tsv file");
  std::sort(files.begin(), files.end());
  return files;
}

LoadedData readFile(const fs::path& file, const Configuration& configuration,
                    const KeepGoing& keep_going) {
  if (file.extension() == ".bag") return readBag(file, configuration, keep_going);
  return readCsv(file, configuration);
}

/// Puts the name of the file before ids that several files use.
void makeIdsDistinct(std::vector<std::pair<fs::path, LoadedData>>& parts) {
  std::map<std::string, int> files_with;
  for (const auto& [file, data] : parts) {
    std::set<std::string> ids;
    for (const auto& experiment : data.experiments) ids.insert(experiment.id);
    for (const auto& id : ids) ++files_with[id];
  }
  for (auto& [file, data] : parts)
    for (auto& experiment : data.experiments)
      if (files_with[experiment.id] > 1) experiment.id = file.stem().string() + "/" + experiment.id;
}

/// Files of one logger share what was assumed about them, and what is wrong with them: it is said
/// once, of the first file and so many others.
std::vector<std::string> saidOnce(const std::vector<std::pair<fs::path, LoadedData>>& parts) {
  struct Said {
    std::string of, what;  ///< "FILE: " is taken off, if it is there
    int times = 1;
  };
  std::vector<Said> all;
  for (const auto& [file, data] : parts) {
    const std::string prefix = file.string() + ": ";
    for (const std::string& warning : data.warnings) {
      const bool is_of_file = warning.rfind(prefix, 0) == 0;
      const std::string what = is_of_file ? warning.substr(prefix.size()) : warning;
      const auto said =
          std::find_if(all.begin(), all.end(), [&](const Said& one) { return one.what == what; });
      if (said != all.end())
        ++said->times;
      else
        all.push_back({is_of_file ? file.string() : "", what});
    }
  }
  std::vector<std::string> warnings;
  for (const Said& one : all) {
    const std::string others = one.times == 2 ? " and another file"
                               : one.times > 2
                                   ? " and " + std::to_string(one.times - 1) + " other files"
                                   : "";
    warnings.push_back(one.of.empty() ? one.what : one.of + others + ": " + one.what);
  }
  return warnings;
}

void requireExperiments(const LoadedData& data) {
  if (!data.experiments.empty()) return;
  std::string message = "no experiment was found in the data";
  for (const auto& rejected : data.rejected) message += "\n" + rejected.id + ": " + rejected.reason;
  for (const auto& warning : data.warnings) message += "\n" + warning;
  throw DataError(message);
}

}  // namespace

std::vector<std::string> dataFiles(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const auto& path : paths)
    for (const auto& file : filesOf(path)) files.push_back(file.string());
  return files;
}

LoadedData loadData(const std::vector<std::string>& paths, const Configuration& configuration,
                    const KeepGoing& keep_going) {
  std::vector<std::pair<fs::path, LoadedData>> parts;
  for (const fs::path file : dataFiles(paths))
    parts.emplace_back(file, readFile(file, configuration, keep_going));
  makeIdsDistinct(parts);
  LoadedData data;
  std::vector<std::string> warnings = saidOnce(parts);
  for (auto& part : parts) append(std::move(part.second), data);
  data.warnings = std::move(warnings);
  requireExperiments(data);
  return data;
}

}  // namespace uncertainty_identification
