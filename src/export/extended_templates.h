#pragma once

#include <string>

namespace uncertainty_identification {

/// The files of templates/, built into this library by cmake/extended_templates.cmake. What was
/// found replaces the mark @FOUND@ in each.
struct ExtendedTemplates {
  std::string python, cpp;
};

const ExtendedTemplates& extendedTemplates();

}  // namespace uncertainty_identification
