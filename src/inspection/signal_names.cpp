#include "inspection/signal_names.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <vector>

namespace uncertainty_identification {
namespace {

const std::map<std::string, NameHint>& knownWords() {
  static const std::map<std::string, NameHint> words = [] {
    std::map<std::string, NameHint> all;
    const auto add = [&all](SignalRole role, int strength, const std::vector<std::string>& names) {
      for (const std::string& name : names) all[name] = {role, strength, name};
    };
    add(SignalRole::input, 2,
        {"input", "in", "cmd", "command", "commanded", "control", "setpoint", "sp", "target",
         "desired", "reference", "ref", "duty", "pwm", "throttle", "actuator", "excitation",
         "demand", "goal"});
    add(SignalRole::output, 2,
        {"output", "out", "measured", "measurement", "meas", "sensor", "feedback", "actual",
         "response", "odom", "encoder", "state"});
    add(SignalRole::input, 1,
        {"voltage", "volt", "volts", "effort", "torque", "force", "heater", "valve", "pump",
         "drive"});
    add(SignalRole::output, 1,
        {"position", "pos", "velocity", "vel", "speed", "angle", "rpm", "temperature", "temp",
         "level", "acceleration", "gyro", "imu", "pose", "twist", "omega"});
    return all;
  }();
  return words;
}

std::vector<std::string> wordsOf(const std::string& name) {
  std::vector<std::string> words;
  std::string word;
  bool was_lower = false;
  const auto finish = [&] {
    if (!word.empty()) words.push_back(word);
    word.clear();
  };
  for (const char character : name) {
    const auto code = static_cast<unsigned char>(character);
    if (std::isalpha(code) == 0 || (std::isupper(code) != 0 && was_lower)) finish();
    was_lower = std::islower(code) != 0;
    if (std::isalpha(code) != 0) word += static_cast<char>(std::tolower(code));
  }
  finish();
  return words;
}

/// Commands weigh more than quantities, and a command more than what is measured of the same
/// strength: the measured quantity of a command is still a command.
bool weighsMore(const NameHint& left, const NameHint& right) {
  if (left.strength != right.strength) return left.strength > right.strength;
  return left.role == SignalRole::input && right.role == SignalRole::output;
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// For u and y, also one of several: "u2", "y_1".
NameHint hintOfLetter(const std::string& name) {
  const std::string rest = name.empty() ? "" : name.substr(1);
  if (rest.find_first_not_of("_0123456789") != std::string::npos) return {};
  const std::string letter = lowered(name.substr(0, 1));
  const int strength = rest.empty() ? 3 : 2;
  if (letter == "u") return {SignalRole::input, strength, letter};
  if (letter == "y") return {SignalRole::output, strength, letter};
  return {};
}

}  // namespace

NameHint hintOf(const std::string& name) {
  NameHint hint = hintOfLetter(name);
  if (hint.strength > 0) return hint;
  for (const std::string& word : wordsOf(name)) {
    const auto known = knownWords().find(word);
    if (known == knownWords().end()) continue;
    if (weighsMore(known->second, hint)) hint = known->second;
  }
  return hint;
}

std::string unitOfName(const std::string& name) {
  if (name.size() > 2 && (name.back() == ']' || name.back() == ')')) {
    const auto open = name.rfind(name.back() == ']' ? '[' : '(');
    const std::string inside =
        open == std::string::npos ? "" : name.substr(open + 1, name.size() - open - 2);
    const bool is_index = inside.find_first_not_of("0123456789") == std::string::npos;
    return is_index ? "" : inside;
  }
  static const std::map<std::string, std::string> units = {
      {"deg", "deg"},   {"degrees", "deg"}, {"rad", "rad"},      {"rpm", "rpm"},   {"volt", "V"},
      {"volts", "V"},   {"voltage", "V"},   {"mv", "mV"},        {"amps", "A"},    {"ma", "mA"},
      {"percent", "%"}, {"pct", "%"},       {"celsius", "degC"}, {"degc", "degC"}, {"kelvin", "K"},
      {"mm", "mm"},     {"cm", "cm"},       {"meters", "m"},     {"nm", "N m"},    {"hz", "Hz"},
      {"mps", "m/s"},   {"rads", "rad/s"},  {"radps", "rad/s"},  {"dps", "deg/s"}};
  const std::vector<std::string> words = wordsOf(name);
  if (words.empty()) return "";
  const auto known = units.find(words.back());
  return known == units.end() ? "" : known->second;
}

}  // namespace uncertainty_identification
