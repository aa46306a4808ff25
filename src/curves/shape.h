#pragma once

#include <string>
#include <vector>

#include "curves/place.h"

namespace uncertainty_identification {

/// How a parameter of a shape changes with the unit of what goes into the curve.
enum class ShapeUnit { none, of_signal, per_signal };

struct ShapeParameter {
  std::string name;
  ShapeUnit unit = ShapeUnit::none;
  bool is_size = false;  ///< only its magnitude counts
};

/// A curve with a name: a dead zone, Coulomb friction, a square root.
struct Shape {
  std::string name;
  /// Value at z, which is counted from the signal's physical zero in standard deviations.
  double (*value)(double z, const double* parameters);
  std::vector<ShapeParameter> parameters;
  std::vector<std::vector<double>> starts;  ///< values of the parameters to begin with
  /// The value is the whole characteristic, of slope 1 in the mean, and has no amplitude: dead
  /// zones and limits. Otherwise the curve is an amplitude times the value.
  bool is_whole = false;
  bool needs_zero = false;  ///< the physical zero must lie within the data
  bool opposes = false;     ///< fed back, it acts against its argument, as friction and drag do
  bool levels_off = false;  ///< what passes through it is steepest at the physical zero

  int count() const { return static_cast<int>(parameters.size()) + (is_whole ? 0 : 1); }
};

/// Degree by which the amplitude of a shape changes with the unit of its argument; `parameters` are
/// the shape's own.
double degreeOf(const Shape& shape, const double* parameters);

/// All shapes.
const std::vector<Shape>& shapes();

/// Whether a machine with a curve of this shape stops and starts: dead zones and dry friction.
bool sticks(const std::string& shape);

/// The shapes that occur at a place, the simplest first: of two that the data cannot tell apart,
/// the first is named.
std::vector<const Shape*> shapesAt(Place place);

}  // namespace uncertainty_identification
