#include "io/grouped_number.h"

#include <array>
#include <cstddef>
#include <locale>
#include <sstream>
#include <utility>

namespace uncertainty_identification {
namespace {

/// Writes the blanks and apostrophes that spreadsheets use as plain ones.
std::string inPlainCharacters(std::string text) {
  static const std::array<std::pair<const char*, char>, 4> kOthers = {{
      {"\xC2\xA0", ' '},       // no-break space
      {"\xE2\x80\xAF", ' '},   // narrow no-break space
      {"\xE2\x80\x89", ' '},   // thin space
      {"\xE2\x80\x99", '\''},  // right single quotation mark
  }};
  for (const auto& [bytes, character] : kOthers) {
    const std::string searched = bytes;
    for (auto at = text.find(searched); at != std::string::npos; at = text.find(searched, at))
      text.replace(at, searched.size(), 1, character);
  }
  return text;
}

std::size_t digitsAt(const std::string& text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && isDigit(text[end])) ++end;
  return end - at;
}

double valueOf(const std::string& plain) {
  std::istringstream stream(plain);
  stream.imbue(std::locale::classic());
  double value = 0;
  stream >> value;
  return value;
}

}  // namespace

bool GroupedNumber::isClear() const {
  return point != '\0' || separators > 1 || separator == ' ' || separator == '\'';
}

std::optional<GroupedNumber> groupedNumber(const std::string& written) {
  const std::string text = inPlainCharacters(written);
  std::size_t at = !text.empty() && (text[0] == '-' || text[0] == '+') ? 1 : 0;
  const std::size_t first = digitsAt(text, at);
  if (first < 1 || first > 3 || text[at] == '0') return std::nullopt;
  std::string plain = text.substr(0, at + first);
  if (plain[0] == '+') plain.erase(0, 1);
  at += first;
  GroupedNumber number;
  if (at < text.size()) number.separator = text[at];
  if (std::string(",. '").find(number.separator) == std::string::npos) return std::nullopt;
  for (; at < text.size() && text[at] == number.separator; at += 4, ++number.separators) {
    if (digitsAt(text, at + 1) != 3) return std::nullopt;
    plain += text.substr(at + 1, 3);
  }
  if (number.separators == 0) return std::nullopt;
  if (at < text.size()) {
    number.point = text[at];
    const std::size_t fraction = digitsAt(text, at + 1);
    if ((number.point != '.' && number.point != ',') || at + 1 + fraction != text.size())
      return std::nullopt;
    plain += "." + text.substr(at + 1);
  }
  number.value = valueOf(plain);
  return number;
}

}  // namespace uncertainty_identification
