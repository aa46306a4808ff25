#include "io/tree_reader.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <utility>

#include "configuration/edit_distance.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

std::string describe(const json& node) {
  if (node.is_null()) return "nothing";
  if (node.is_string()) return "'" + node.get<std::string>() + "'";
  if (node.is_object()) return "a group of keys";
  if (node.is_array()) return "a list";
  return node.dump();
}

// The whole text as a number, whatever the user's locale; 1e-6 included, nan and inf not.
template <class Number>
bool parse(const std::string& text, Number& number) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  return (stream >> number) && stream.peek() == std::istringstream::traits_type::eof();
}

std::string lineOf(const std::map<std::string, int>& lines, const std::string& path) {
  const auto found = lines.find(path);
  return found == lines.end() ? "" : " (line " + std::to_string(found->second) + ")";
}

}  // namespace

TreeReader::TreeReader(const json& node, const std::map<std::string, int>& lines, ReadingRule rule,
                       std::string path)
    : node_(node), lines_(lines), rule_(rule), path_(std::move(path)) {
  const bool empty =
      node_.is_null() && rule_ == ReadingRule::configuration;  // a heading without keys
  if (!node_.is_object() && !empty)
    fail(node_, path_.empty() ? "the document" : path_, "a group of keys");
}

const json* TreeReader::find(const std::string& key) {
  keys_.push_back(key);
  const auto found = node_.find(key);
  if (found != node_.end()) return &*found;
  if (rule_ == ReadingRule::record) {
    throw ConfigurationError(pathOf(path_, key) + ": missing (is the file truncated?)");
  }
  return nullptr;
}

void TreeReader::fail(const json& node, const std::string& path,
                      const std::string& expected) const {
  throw ConfigurationError(path + lineOf(lines_, path) + ": found " + describe(node) +
                           "; expected " + expected);
}

void TreeReader::finish() const {
  if (rule_ == ReadingRule::record) return;
  for (const auto& [key, value] : node_.items()) {
    const auto distance = [unknown = key](const std::string& known) {
      return editDistance(unknown, known);
    };
    if (std::find(keys_.begin(), keys_.end(), key) != keys_.end()) continue;
    const auto nearest = std::min_element(keys_.begin(), keys_.end(),
                                          [&](const std::string& left, const std::string& right) {
                                            return distance(left) < distance(right);
                                          });
    const std::string path = pathOf(path_, key);
    throw ConfigurationError(path + lineOf(lines_, path) + ": unknown key; did you mean " +
                             pathOf(path_, *nearest) + "?");
  }
}

void TreeReader::requireList(const json& node, const std::string& path) const {
  if (!node.is_array()) fail(node, path, "a list");
}

double TreeReader::number(const json& node, const std::string& path,
                          const std::string& expected) const {
  double value = 0;
  if (node.is_null() && rule_ == ReadingRule::record)
    return std::numeric_limits<double>::quiet_NaN();
  if (node.is_number()) return node.get<double>();
  if (node.is_string() && parse(node.get<std::string>(), value)) return value;
  fail(node, path, expected);
}

std::int64_t TreeReader::integer(const json& node, const std::string& path,
                                 const std::string& expected) const {
  if (node.is_number_integer()) return node.get<std::int64_t>();
  constexpr double kExact = 9007199254740992.0;  // 2^53: every whole number below is a double
  const double value = node.is_null() ? 0.5 : number(node, path, expected);
  if (value != std::floor(value) || std::abs(value) > kExact) fail(node, path, expected);
  return static_cast<std::int64_t>(value);
}

void TreeReader::read(const json& node, const std::string& path, double& value) const {
  value = number(node, path, "a number");
}

void TreeReader::read(const json& node, const std::string& path, int& value) const {
  const std::int64_t wide = integer(node, path, "a whole number");
  if (std::abs(wide) > std::numeric_limits<int>::max()) fail(node, path, "a smaller whole number");
  value = static_cast<int>(wide);
}

void TreeReader::read(const json& node, const std::string& path, long& value) const {
  value = static_cast<long>(integer(node, path, "a whole number"));
}

void TreeReader::read(const json& node, const std::string& path, std::uint64_t& value) const {
  const std::string expected = "a whole number, 0 or above";
  if (node.is_number_unsigned()) {
    value = node.get<std::uint64_t>();
  } else if (!node.is_string() || node.get<std::string>().find('-') != std::string::npos ||
             !parse(node.get<std::string>(), value)) {
    fail(node, path, expected);
  }
}

void TreeReader::read(const json& node, const std::string& path, bool& value) const {
  if (node.is_boolean()) {
    value = node.get<bool>();
  } else if (!node.is_string() ||
             !YAML::convert<bool>::decode(YAML::Node(node.get<std::string>()), value)) {
    fail(node, path, "true or false");
  }
}

void TreeReader::read(const json& node, const std::string& path, std::string& value) const {
  if (!node.is_string()) fail(node, path, "text");
  value = node.get<std::string>();
}

void TreeReader::read(const json& node, const std::string& path, Eigen::VectorXd& value) const {
  std::vector<double> entries;
  read(node, path, entries);
  value =
      Eigen::Map<const Eigen::VectorXd>(entries.data(), static_cast<Eigen::Index>(entries.size()));
}

void TreeReader::read(const json& node, const std::string& path, Eigen::MatrixXd& value) const {
  std::vector<Eigen::VectorXd> rows;
  read(node, path, rows);
  const Eigen::Index columns = rows.empty() ? 0 : rows.front().size();
  value.resize(static_cast<Eigen::Index>(rows.size()), columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].size() != columns) fail(node[i], pathOf(path, i), "a row as long as the first");
    value.row(static_cast<Eigen::Index>(i)) = rows[i];
  }
}

void TreeReader::read(const json& node, const std::string& path, Word& value) const {
  if (node != json(value.word)) fail(node, path, "'" + value.word + "'");
}

}  // namespace uncertainty_identification
