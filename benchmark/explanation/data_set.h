#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "oracle.h"
#include "support/hidden_effects/hidden_effect.h"
#include "uncertainty_identification/explanation/explanation.h"

/// Data sets with random hidden effects, and what explain() says about them.
namespace uncertainty_identification::suite {

/// One data set, and how it is to be explained.
struct Task {
  std::string part;                 ///< of the suite: "single", "clean", ...
  std::vector<std::string> hidden;  ///< names of the effects; empty when nothing is hidden
  int run = 1;                      ///< determines all random numbers, together with the names
  test::HiddenEffectOptions options;
  bool removed =
      false;  ///< explain() does not know the hidden effects and those equivalent to them
  bool orders_auto = false;  ///< explain() chooses the orders of the nominal model itself
  int threads = kAutomatic;
  int fresh = 0;  ///< number of further experiments on which the gain is measured again

  /// Names the data set in one line.
  std::string title() const;

  /// Depends on the names of the hidden effects and on the run only.
  std::uint64_t seed() const;
};

/// A parameter of a hidden effect that was found.
struct RecoveredParameter {
  std::string effect, name;
  double truth = 0, estimate = 0;
  std::optional<bool> covered;  ///< whether the 90 % interval, if there is one, contains the truth

  /// |estimate - truth|/|truth|.
  double relativeError() const;
};

/// The result of a task.
struct Outcome {
  Task task;
  test::HiddenEffect hidden;
  std::string failure;  ///< message of the exception of explain(), if any
  Verdict verdict = Verdict::none;
  std::vector<Cause> causes;
  std::vector<RecoveredParameter> parameters;
  std::optional<Gain> fresh_gain;   ///< of the cause on the Task::fresh experiments, when exact()
  std::optional<double> true_gain;  ///< [nats] trueGain() on them, whatever was found
  double seconds = 0;               ///< [s] that explain() took

  /// How many of the hidden effects were found: a cause has their name and the right covariate, or
  /// it has an equivalent name and lists theirs as equivalent.
  int found() const;
  /// Whether all hidden effects were found.
  bool right() const { return found() == static_cast<int>(hidden.names.size()); }
  /// Whether exactly the hidden effects were found, and they explain the data.
  bool exact() const;
  /// Whether explain() says that something remains unexplained.
  bool raisesUnknown() const { return verdict >= Verdict::partly_explained; }
  /// Whether a cause other than noise and outliers was found.
  bool namesStructure() const;
  /// Task, causes, verdict and seconds in one line.
  std::string line() const;
};

/// Sets of effects that act so similarly that the data of one kind of experiment cannot tell them
/// apart.
const std::vector<std::vector<std::string>>& equivalenceClasses();

/// Draws the system of a task and its effects.
test::HiddenEffect hide(const Task& task);

/// Simulates the data, explains them and compares the result with the truth.
Outcome carryOut(const Task& task);

/// Writes the data of a task to a folder: training.csv, held_out.csv, configuration.yaml (what
/// explain() is given) and truth.json.
void writeData(const Task& task, const std::string& folder);

}  // namespace uncertainty_identification::suite
