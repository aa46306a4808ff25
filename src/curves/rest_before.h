#pragma once

#include <optional>
#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Input and output of a system at rest, in the units of the data.
struct RestingPoint {
  double u = 0, y = 0;
};

/// Where the systems rested before their records began, as far as the records show it. An initial
/// state that is free could stand for much of a short record, such as the whole answer to a step.
class RestBefore {
 public:
  /// Learns from all experiments whether they begin at one level whatever their first inputs are.
  explicit RestBefore(const std::vector<Experiment>& experiments);

  /// Nothing, unless the input makes few steps, and the output stands still until the input moves
  /// for the first time, or begins at that level with an input that is constant, and so was
  /// switched on just then.
  std::optional<RestingPoint> of(const Experiment& experiment) const;

 private:
  std::optional<double> level_;  ///< at which all begin
  double tolerance_ = 0;
};

}  // namespace uncertainty_identification
