#pragma once

#include <string>

#include "export/exported_model.h"

namespace uncertainty_identification {

/// A MATLAB file of version 5 with the arrays of namedArrays() and the text `about`.
std::string matFile(const ExportedModel& model);

/// A Python module of these arrays that needs numpy only, builds the systems of python-control on
/// request, and checks itself when run.
std::string pythonModule(const ExportedModel& model);

/// A function file of Octave and MATLAB that returns these arrays and, on request, systems of the
/// control package, and checks itself when called with 'check'.
std::string octaveFunction(const ExportedModel& model);

/// YAML for `rosparam load`: nominal model, noise model, weight and what is known of the spread.
std::string rosParameters(const ExportedModel& model);

/// One C99 file, header and source in one, without allocation: the simulator of Go and the
/// whitening filter H^-1. Compiled with -DSELF_CHECK it is a program that compares them with
/// signals that the library computed.
std::string cSource(const ExportedModel& model);

}  // namespace uncertainty_identification
