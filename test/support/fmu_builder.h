#pragma once

#include <map>
#include <string>
#include <vector>

namespace uncertainty_identification::test {

/// A functional mock-up unit that is built from test/data/fmu/motor.c.
struct FmuRecipe {
  std::string interface = "CO_SIMULATION_2";  ///< or MODEL_EXCHANGE_2, CO_SIMULATION_3
  std::vector<std::string> defines;           ///< further ones, such as "FAULT=1"
  std::string description;                    ///< modelDescription.xml; empty: that of the motor
  std::map<std::string, std::string> more;    ///< further entries of the archive: name, text
  std::vector<std::string> without;           ///< entries that it lacks
};

/// modelDescription.xml of the motor with this interface.
std::string motorDescription(const std::string& interface);

/// Compiles and packs it. Throws std::runtime_error with what the compiler says.
void buildFmu(const std::string& path, const FmuRecipe& recipe);

}  // namespace uncertainty_identification::test
