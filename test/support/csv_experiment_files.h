#pragma once

#include <filesystem>

#include "session/experiment_files.h"
#include "uncertainty_identification/io/csv.h"

namespace uncertainty_identification {

/// Experiments in CSV files, for tests that need no ROS bags.
inline ExperimentFiles csvExperimentFiles() {
  return {
      [](const std::string& path, const std::vector<const Experiment*>& experiments) {
        std::vector<Experiment> copies;
        for (const Experiment* experiment : experiments) copies.push_back(*experiment);
        writeCsv(path, copies);
      },
      [](const std::string& path) { return readCsv(path); },
      [](const std::string& path) -> std::uint64_t { return std::filesystem::file_size(path); }};
}

}  // namespace uncertainty_identification
