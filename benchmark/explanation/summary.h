#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data_set.h"

/// What many outcomes amount to, and whether that is enough.
namespace uncertainty_identification::suite {

/// A share or a figure held against what it must reach.
class Targets {
 public:
  /// In the short form a share is missed only if the required one would give so few with a
  /// probability below 1 %.
  explicit Targets(bool short_form) : short_form_(short_form) {}

  void share(const std::string& what, int good, int all, double least);
  void atMost(const std::string& what, double value, double most);
  void atLeast(const std::string& what, double value, double least);

  /// Wall time, which on a machine with other work says little: the short form allows ten times it.
  void time(const std::string& what, double seconds, double most);

  /// One line each; exit status 0 when none is missed.
  int report() const;

 private:
  void add(const std::string& what, const std::string& found, const std::string& wanted, bool met);

  bool short_form_;
  int missed_ = 0;
  std::string lines_;
};

double median(std::vector<double> values);

/// One line for each hidden effect: data sets, right, exact, unknown, median time, and what was
/// named instead or beside it: the rows of the confusion matrix, without its zeros.
void printConfusion(const std::vector<Outcome>& outcomes);

/// Median relative error and share of 90 % intervals that hold the truth, of each parameter whose
/// effect was named exactly.
void printParameters(const std::vector<Outcome>& outcomes);

/// Everything about the outcomes.
nlohmann::json toJson(const std::vector<Outcome>& outcomes);

}  // namespace uncertainty_identification::suite
