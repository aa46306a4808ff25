#pragma once

#include <string>
#include <vector>

#include "curves/screening_places.h"

/// Names and words of places and shapes.
namespace uncertainty_identification {

/// The name of a cause, such as "act_deadzone" for a dead zone of the input.
std::string causeNamed(Place place, const std::string& shape);

/// All names that causeNamed() gives, and that of dead time.
std::vector<std::string> curveCauseNames();

/// Whether a name is one of these: of a cause that the free simulation can show.
bool isCurveCause(const std::string& name);

/// The cause within the plant that lies between a smooth curve of the input and one of the sensor;
/// empty unless both are among the names.
std::string causeBetween(const std::vector<std::string>& names);

/// "a dead zone".
std::string shapeInWords(const std::string& shape);

/// "the input acts through a dead zone".
std::string inWords(const PlaceOf& at, const std::string& shape);

/// What to check, or to record next, for a cause at a place.
std::string adviceFor(Place place);

}  // namespace uncertainty_identification
