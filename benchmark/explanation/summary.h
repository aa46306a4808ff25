#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data_set.h"

/// Summaries of many outcomes, and their comparison with targets.
namespace uncertainty_identification::suite {

/// A list of results, each compared with its target.
class Targets {
 public:
  /// In the short form a share misses its target only if so few successes would have a probability
  /// below 1 % when the target is true.
  explicit Targets(bool short_form) : short_form_(short_form) {}

  void share(const std::string& what, int good, int all, double least);
  void atMost(const std::string& what, double value, double most);
  void atLeast(const std::string& what, double value, double least);

  /// A time. The short form allows ten times the target, since the machine may have other work.
  void time(const std::string& what, double seconds, double most);

  /// Prints a line for each target. Returns the exit status: 0 when none is missed, else 1.
  int report() const;

 private:
  void add(const std::string& what, const std::string& found, const std::string& wanted, bool met);

  bool short_form_;
  int missed_ = 0;
  std::string lines_;
};

double median(std::vector<double> values);

/// Prints one line for each hidden effect: the number of data sets; those that are right(), exact()
/// and raisesUnknown(); the median time; and the effects that were found without being hidden, with
/// their numbers.
void printConfusion(const std::vector<Outcome>& outcomes);

/// Prints, for each parameter of effects that were found exactly, the median relative error and the
/// share of 90 % intervals that contain the truth.
void printParameters(const std::vector<Outcome>& outcomes);

/// All outcomes with all that is known about them.
nlohmann::json toJson(const std::vector<Outcome>& outcomes);

}  // namespace uncertainty_identification::suite
