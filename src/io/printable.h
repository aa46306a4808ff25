#pragma once

#include <string>

namespace uncertainty_identification {

/// A text from a file or a request as it can be shown in one line: control characters, and bytes
/// that are no UTF-8, are written as \xNN.
std::string printable(const std::string& text);

/// The same for a text of several lines, whose line breaks stay.
std::string printableText(const std::string& text);

/// Whether printable() would leave the text as it is.
bool isPrintable(const std::string& text);

}  // namespace uncertainty_identification
