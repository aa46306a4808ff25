#pragma once

#include <string>

#include "inspection/inspected_data.h"

namespace uncertainty_identification {

/// What inspecting data found as one page of HTML that needs no other file: the text, input and
/// output of each experiment as pictures, and for a single record where it was cut.
std::string inspectionHtml(const InspectedData& data);

}  // namespace uncertainty_identification
