#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "oracle.h"
#include "support/hidden_effects/hidden_effect.h"
#include "uncertainty_identification/explanation/explanation.h"

/// Data sets with effects hidden at random, and what explain() says of them.
namespace uncertainty_identification::suite {

/// One data set and how it is explained.
struct Task {
  std::string part;                 ///< of the suite: "single", "clean", ...
  std::vector<std::string> hidden;  ///< names; empty: nothing
  int run = 1;                      ///< with the names the seed of everything that is random
  test::HiddenEffectOptions options;
  bool removed = false;      ///< the hidden effects and their equivalents are not in the catalogue
  bool orders_auto = false;  ///< the orders of the nominal model are not told
  int threads = kAutomatic;
  int fresh = 0;  ///< experiments that the gain is measured on again; 0 = none

  /// A line of text that names the data set.
  std::string title() const;

  /// Follows from the hidden names and the run alone.
  std::uint64_t seed() const;
};

/// A parameter of a hidden effect that was named.
struct RecoveredParameter {
  std::string effect, name;
  double truth = 0, estimate = 0;
  std::optional<bool> covered;  ///< the truth lies in the 90 % interval, where there is one

  /// |estimate - truth|/|truth|.
  double relativeError() const;
};

/// What became of a task.
struct Outcome {
  Task task;
  test::HiddenEffect hidden;
  std::string failure;  ///< what explain() threw; empty: nothing
  Verdict verdict = Verdict::none;
  std::vector<Cause> causes;
  std::vector<RecoveredParameter> parameters;
  std::optional<Gain> fresh_gain;   ///< of the cause, on Task::fresh other experiments, when exact
  std::optional<double> true_gain;  ///< what there was to gain on them [nats], whatever was named
  double seconds = 0;               ///< [s] of explain()

  /// How many of the hidden effects are among the causes, by their own name or by an equivalent one
  /// that lists it, and the right covariate.
  int found() const;
  bool right() const { return found() == static_cast<int>(hidden.names.size()); }
  /// The truth and nothing else, and no check fails with it.
  bool exact() const;
  bool raisesUnknown() const { return verdict >= Verdict::partly_explained; }
  /// Whether a cause other than noise and outliers is named.
  bool namesStructure() const;
  /// One line: task, causes, verdict, seconds.
  std::string line() const;
};

/// Sets of names that data of one experiment design cannot tell apart.
const std::vector<std::vector<std::string>>& equivalenceClasses();

/// The data of a task.
test::HiddenEffect hide(const Task& task);

/// Simulates, explains and compares.
Outcome carryOut(const Task& task);

/// The data of a task as training.csv, held_out.csv, configuration.yaml (what is declared) and
/// truth.json in a folder.
void writeData(const Task& task, const std::string& folder);

}  // namespace uncertainty_identification::suite
