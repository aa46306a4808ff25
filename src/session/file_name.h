#pragma once

#include <string>

namespace uncertainty_identification {

/// Whether a name given in a request is only a file name, without any folder: it consists of
/// letters, digits, '.', '_' and '-', does not begin with '.', has at most 200 characters and ends
/// in `ending`, for example ".html".
bool isPlainFileName(const std::string& name, const std::string& ending);

}  // namespace uncertainty_identification
