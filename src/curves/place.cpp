#include "curves/place.h"

#include <array>

namespace uncertainty_identification {

std::string nameOf(Place place) {
  static const std::array<const char*, 18> kNames{"input",
                                                  "position",
                                                  "rate",
                                                  "position_gain",
                                                  "input_times_position",
                                                  "sensor",
                                                  "play",
                                                  "rate_limit",
                                                  "time_gain",
                                                  "time",
                                                  "output_play",
                                                  "covariate",
                                                  "covariate_gain",
                                                  "rate_gain",
                                                  "output_state",
                                                  "loop_error",
                                                  "hysteresis",
                                                  "input_hysteresis"};
  return kNames.at(static_cast<std::size_t>(place));
}

bool isSamePlace(Place left, Place right) {
  const auto without_state = [](Place place) {
    return place == Place::output_state ? Place::position : place;
  };
  return without_state(left) == without_state(right);
}

bool isScalar(Place place) {
  return place == Place::play || place == Place::rate_limit || place == Place::output_play ||
         place == Place::input_hysteresis;
}

int linearPart(Place place) {
  switch (place) {
    case Place::input:
    case Place::position:
    case Place::rate:
    case Place::sensor:
    case Place::output_state:
    case Place::loop_error:
      return 2;
    default:
      return 1;
  }
}

bool hasPhysicalZero(Place place) {
  return place == Place::input || place == Place::position || place == Place::rate ||
         place == Place::rate_gain || place == Place::output_state || place == Place::loop_error;
}

bool isPassed(Place place) {
  return place == Place::input || place == Place::loop_error || place == Place::sensor;
}

bool isFedBack(Place place) {
  return place == Place::position || place == Place::rate || place == Place::output_state ||
         place == Place::loop_error || place == Place::hysteresis;
}

}  // namespace uncertainty_identification
