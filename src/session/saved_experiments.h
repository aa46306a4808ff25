#pragma once

#include <string>

#include "session/experiment_files.h"
#include "session/identification_worker.h"

namespace uncertainty_identification {

/// Saves a node's experiments to files in one folder, <store_directory>/saved/, and loads them from
/// there. Names in requests cannot lead out of that folder.
class SavedExperiments {
 public:
  /// If `store_directory` is empty, all requests are refused.
  SavedExperiments(const std::string& store_directory, ExperimentFiles files,
                   const LimitOptions& limits, IdentificationWorker& worker);

  struct Saved {
    std::string path;  ///< the file that was written
    int experiments = 0;
  };

  /// Writes all experiments of the worker into a new file by `write`. Writes nothing when there are
  /// no experiments; the returned count is 0 then. Throws RefusedError when the name is not allowed
  /// or in use or the folder holds limits.max_saved_files files, and what `write` throws.
  Saved save(const std::string& name, const WriteExperiments& write) const;

  struct Loaded {
    int added = 0;
    int known = 0;  ///< experiments that the worker has already; not added
  };

  /// Adds the experiments of a file to the worker. Those that the worker has are left out; those
  /// that were taken out by a request are added again. Throws RefusedError when the name is not
  /// allowed or the file exceeds limits.max_bag_size, FileError when it cannot be read, DataError
  /// when it holds no experiments.
  Loaded load(const std::string& name);

 private:
  std::string newFile(const std::string& name) const;

  std::string directory_;  // empty: requests are refused
  ExperimentFiles files_;
  LimitOptions limits_;
  IdentificationWorker& worker_;
};

}  // namespace uncertainty_identification
