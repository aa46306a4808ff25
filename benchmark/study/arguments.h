#pragma once

#include <map>
#include <string>
#include <vector>

#include "study/tasks.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification::study {

/// Arguments of a study, as `--name value` or `--name`.
class Arguments {
 public:
  /// The allowed names, each with what it does; those in `flags` have no value. Every study has
  /// --jobs, --task-seconds, --minutes, --config and --orders-auto. Prints the usage and exits with
  /// 2 if an argument is not among them.
  Arguments(int argc, char** argv, std::map<std::string, std::string> allowed,
            const std::vector<std::string>& flags);

  bool has(const std::string& name) const { return values_.count(name) > 0; }
  std::string text(const std::string& name, const std::string& otherwise) const;
  double number(const std::string& name, double otherwise) const;

  /// "1,3,8", or "2:5" for 2, 3, 4, 5.
  std::vector<int> numbers(const std::string& name, const std::string& otherwise) const;

  TaskLimits limits(double minutes) const;

  /// The default configuration, or that of --config; --orders-auto changes it. One thread: the
  /// study runs several identifications at a time.
  Configuration configuration() const;

 private:
  std::map<std::string, std::string> values_;
};

}  // namespace uncertainty_identification::study
