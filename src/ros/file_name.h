#pragma once

#include <string>

namespace uncertainty_identification {

/// Whether a name in a request is one of a file and nothing else: letters, digits, '.', '_' and
/// '-', no '.' in front, at most 200 characters, ending in `ending`, e.g. ".html".
bool isPlainFileName(const std::string& name, const std::string& ending);

}  // namespace uncertainty_identification
