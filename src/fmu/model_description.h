#pragma once

#include <string>
#include <vector>

/// Functional mock-up units (FMU): simulations that other tools export, by the FMI standard.
namespace uncertainty_identification {

/// A variable of an FMU that holds floating-point numbers.
struct FmuVariable {
  std::string name;
  unsigned int reference = 0;  ///< the FMU's number of it
  std::string causality;       ///< "input", "output", "parameter", "local", ...
  std::string unit;            ///< empty where none is stated
  double start = 0;            ///< NaN where none is stated
};

/// How an FMU is run.
enum class FmuKind { co_simulation_2, model_exchange_2, co_simulation_3 };

/// What modelDescription.xml says.
struct ModelDescription {
  FmuKind kind = FmuKind::co_simulation_2;
  std::string identifier;  ///< name of its library, without folder and extension
  std::string token;       ///< guid, or instantiationToken: the library compares it with its own
  std::vector<FmuVariable> variables;
  int states = 0, event_indicators = 0;  ///< of model exchange

  /// Throws ConfigurationError that names `key`, and the variables of this causality, where there
  /// is none of this name. "parameter" stands for all that have a start value and are no input.
  const FmuVariable& variable(const std::string& key, const std::string& name,
                              const std::string& causality) const;
};

/// Reads the text of modelDescription.xml; of an FMU that offers both, co-simulation is taken.
/// Throws ConfigurationError where it is no XML, or is of a kind that cannot be run.
ModelDescription parseModelDescription(const std::string& xml);

}  // namespace uncertainty_identification
