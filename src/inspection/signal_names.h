#pragma once

#include <string>

namespace uncertainty_identification {

enum class SignalRole { unknown, input, output };

/// What a name says about a signal.
struct NameHint {
  SignalRole role = SignalRole::unknown;
  /// 3: it is called u or y; 2: a word such as command or measured; 1: a word that is common for
  /// such signals, such as voltage
  int strength = 0;
  std::string word = {};  ///< that says so
};

/// By the words of the name, which capitals, digits and signs separate: "wheel_speed",
/// "motorVoltage",
/// "/cmd_vel linear.x". Words that name commands weigh more than those that name quantities:
/// "speed_setpoint" is an input.
NameHint hintOf(const std::string& name);

/// The unit that a name states: the brackets at its end, "angle [deg]", or its last word,
/// "angle_deg"; a voltage is in V. Empty if it states none.
std::string unitOfName(const std::string& name);

}  // namespace uncertainty_identification
