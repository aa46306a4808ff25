#include "bounds/physical_sentence.h"

#include <cstdio>

namespace uncertainty_identification {
namespace {

bool begins(const std::string& name, const char* with) { return name.rfind(with, 0) == 0; }

/// "time_constant_2" as "time constant 2".
std::string spaced(std::string name) {
  for (char& character : name) {
    if (character == '_') character = ' ';
  }
  return name;
}

std::string withUnit(const PhysicalNumber& number) {
  char value[32];
  std::snprintf(value, sizeof value, "%.3g", number.value);
  return value + (number.unit.empty() ? "" : " " + number.unit);
}

/// "Second-order plant that integrates".
std::string kindOf(const std::vector<PhysicalNumber>& numbers) {
  static const char* const kOrders[] = {"Static plant", "First-order plant", "Second-order plant",
                                        "Third-order plant"};
  std::size_t order = 0;
  std::string integrates;
  for (const PhysicalNumber& number : numbers) {
    const bool twice = number.name == "acceleration_gain";
    if (twice || number.name == "velocity_gain") {
      integrates = twice ? " that integrates twice" : " that integrates";
      order += twice ? 2 : 1;
    }
    order += begins(number.name, "time_constant") || begins(number.name, "alternating") ? 1 : 0;
    order += begins(number.name, "natural_frequency") ? 2 : 0;
  }
  return (order < 4 ? kOrders[order] : "Plant of order " + std::to_string(order)) + integrates;
}

}  // namespace

std::string physicalSentence(const std::vector<PhysicalNumber>& numbers) {
  std::string list;
  for (const PhysicalNumber& number : numbers) {
    if (begins(number.name, "damping")) {  // of the natural frequency before it
      list += " with damping " + withUnit(number);
      continue;
    }
    list += list.empty() ? "" : ", ";
    if (begins(number.name, "alternating"))
      list += "pole that alternates at z = " + withUnit(number);
    if (begins(number.name, "alternating")) continue;
    const bool none = number.name == "dead_time" && number.value == 0;
    list += none ? "no dead time" : spaced(number.name) + " " + withUnit(number);
  }
  return kindOf(numbers) + ": " + list + ".";
}

}  // namespace uncertainty_identification
