#pragma once

#include <string>
#include <vector>

#include "identification/problem.h"

namespace uncertainty_identification {

/// A way in which plants may differ from experiment to experiment: the configuration with a nominal
/// model and an error model that can express it.
struct ErrorStructure {
  std::string description;  ///< e.g. "parameter_spread of gain and tau1"
  Configuration configuration;
  /// Fitted only if the structure of this description, fitted before, is better than none; empty:
  /// always.
  std::string if_better{};
};

/// The structures that are compared when the error model is chosen from the data: none; FIR filters
/// in series with Go, with the constraints zero_mean and zero_static_gain; and variedStructures(),
/// unless the problem's plant is fixed. Only the number of taps differs where the configuration
/// states the basis.
std::vector<ErrorStructure> errorStructures(const Problem& problem, const Polynomials* plant);

/// The configuration with parameters of Go that vary.
ErrorStructure spreadOf(const std::vector<std::string>& parameters, Configuration configuration);

/// Structures of parameters of Go that vary. These are the physical ones (gain, time constants,
/// resonances, dead time) where a continuous model can replace `plant`, otherwise those of the
/// configured nominal model. `plant` is null where the user chose the form of the nominal model.
std::vector<ErrorStructure> variedStructures(const Problem& problem, const Polynomials* plant);

/// Whether coefficients of B vary and nothing else, which is what a filter in series with Go whose
/// mean is not one makes of them.
bool isSpreadOfNumerator(const ErrorModelOptions& options);

}  // namespace uncertainty_identification
