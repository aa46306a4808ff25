#include "io/tree_reader.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <locale>
#include <nlohmann/json.hpp>
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

TreeReader::TreeReader(const json& tree, ReadingRule rule, std::map<std::string, int> lines)
    : lines_(std::move(lines)), frames_{{tree, rule, {}, {}, {}}} {}

bool TreeReader::has(std::string_view key) const { return node().contains(std::string(key)); }

bool TreeReader::hasList(std::string_view key) const {
  return has(key) && node()[std::string(key)].is_array();
}

bool TreeReader::isWord(std::string_view key, const char* word) {
  if (!has(key) || node()[std::string(key)] != json(word)) return false;
  frames_.back().known.emplace_back(key);
  return true;
}

bool TreeReader::enter(std::string_view key, bool optional) {
  frames_.back().known.emplace_back(key);
  const ReadingRule rule = frames_.back().rule;
  const auto found = node().find(std::string(key));
  if (found != node().end()) {
    frames_.push_back({*found, rule, key, {}, {}});
    return true;
  }
  if (rule == ReadingRule::record && !optional) {
    throw ConfigurationError(pathOf(path(), std::string(key)) +
                             ": missing (is the file truncated?)");
  }
  return false;
}

void TreeReader::enterEntry(std::size_t index) {
  frames_.push_back({node()[index], frames_.back().rule, {}, index, {}});
}

void TreeReader::beginGroup(bool defaults) {
  if (defaults) frames_.back().rule = ReadingRule::configuration;
  // In a configuration, a heading whose keys are all commented out holds nothing.
  const bool empty = node().is_null() && frames_.back().rule == ReadingRule::configuration;
  if (!node().is_object() && !empty) fail("a group of keys");
}

void TreeReader::endGroup() {
  if (frames_.back().rule == ReadingRule::record) return;
  const std::vector<std::string>& known = frames_.back().known;
  for (const auto& [key, value] : node().items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    const auto nearest =
        std::min_element(known.begin(), known.end(),
                         [unknown = key](const std::string& left, const std::string& right) {
                           return editDistance(unknown, left) < editDistance(unknown, right);
                         });
    const std::string path = pathOf(this->path(), key);
    throw ConfigurationError(path + lineOf(lines_, path) + ": unknown key; did you mean " +
                             pathOf(this->path(), *nearest) + "?");
  }
}

std::size_t TreeReader::beginList(std::size_t) {
  if (!node().is_array()) fail("a list");
  return node().size();
}

std::vector<std::string> TreeReader::beginMap() {
  if (!node().is_object()) fail("keys with values");
  std::vector<std::string> keys;
  for (const auto& [key, value] : node().items()) keys.push_back(key);
  return keys;
}

bool TreeReader::isAutomatic(bool) { return node() == json("auto"); }
bool TreeReader::isNull(bool) { return node().is_null(); }
bool TreeReader::isSingle(bool) { return !node().is_array(); }

std::size_t TreeReader::visitWord(const std::vector<std::string>& words, std::size_t) {
  std::string allowed;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (node() == json(words[i])) return i;
    allowed += (i == 0 ? "" : ", ") + words[i];
  }
  fail((words.size() > 1 ? "one of " : "") + allowed);
}

std::string TreeReader::path() const {
  std::string path;
  for (auto frame = std::next(frames_.begin()); frame != frames_.end(); ++frame)
    path = frame->index ? pathOf(path, *frame->index) : pathOf(path, std::string(frame->key));
  return path;
}

void TreeReader::fail(const std::string& expected) const {
  const std::string path = frames_.size() > 1 ? this->path() : "the document";
  throw ConfigurationError(path + lineOf(lines_, path) + ": found " + describe(node()) +
                           "; expected " + expected);
}

double TreeReader::number(const std::string& expected) const {
  double value = 0;
  if (node().is_null() && frames_.back().rule == ReadingRule::record)
    return std::numeric_limits<double>::quiet_NaN();
  if (node().is_number()) return node().get<double>();
  if (node().is_string() && parse(node().get<std::string>(), value)) return value;
  fail(expected);
}

std::int64_t TreeReader::integer(const std::string& expected) const {
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  if (node().is_number_unsigned() && node().get<std::uint64_t>() > kMost) fail(expected);
  if (node().is_number_integer()) return node().get<std::int64_t>();
  constexpr double kExact = 9007199254740992.0;  // 2^53: every whole number below is a double
  const double value = node().is_null() ? 0.5 : number(expected);
  if (value != std::floor(value) || std::abs(value) > kExact) fail(expected);
  return static_cast<std::int64_t>(value);
}

void TreeReader::visit(double& value) { value = number("a number"); }

void TreeReader::visit(int& value) {
  const std::int64_t wide = integer("a whole number");
  constexpr std::int64_t kMost = std::numeric_limits<int>::max();
  if (wide > kMost || wide < -kMost) fail("a smaller whole number");
  value = static_cast<int>(wide);
}

void TreeReader::visit(long& value) { value = static_cast<long>(integer("a whole number")); }

void TreeReader::visit(std::uint64_t& value) {
  if (node().is_number_unsigned()) {
    value = node().get<std::uint64_t>();
  } else if (!node().is_string() || node().get<std::string>().find('-') != std::string::npos ||
             !parse(node().get<std::string>(), value)) {
    fail("a whole number, 0 or above");
  }
}

void TreeReader::visit(bool& value) {
  if (node().is_boolean()) {
    value = node().get<bool>();
  } else if (!node().is_string() ||
             !YAML::convert<bool>::decode(YAML::Node(node().get<std::string>()), value)) {
    fail("true or false");
  }
}

void TreeReader::visit(std::string& value) {
  if (!node().is_string()) fail("text");
  value = node().get<std::string>();
}

void TreeReader::visit(Eigen::VectorXd& value) {
  std::vector<double> entries;
  visit(entries);
  value =
      Eigen::Map<const Eigen::VectorXd>(entries.data(), static_cast<Eigen::Index>(entries.size()));
}

void TreeReader::visit(Eigen::MatrixXd& value) {
  std::vector<Eigen::VectorXd> rows;
  visit(rows);
  const Eigen::Index columns = rows.empty() ? 0 : rows.front().size();
  value.resize(static_cast<Eigen::Index>(rows.size()), columns);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    enterEntry(i);
    if (rows[i].size() != columns) fail("a row as long as the first");
    leave();
    value.row(static_cast<Eigen::Index>(i)) = rows[i];
  }
}

void TreeReader::visit(Word& value) {
  if (node() != json(value.word)) fail("'" + value.word + "'");
}

void TreeReader::visit(OrAutomatic<int>& value) {
  const std::string expected = "a whole number or auto";
  const bool automatic = isAutomatic(false);
  const std::int64_t wide = automatic ? value.automatic : integer(expected);
  value.value = static_cast<int>(wide);
  const bool given = wide == value.value && value.value != value.automatic;
  if (!automatic && !given) fail(expected);
}

void TreeReader::visit(OrAutomatic<double>& value) {
  const std::string expected = "a number or auto";
  const bool automatic = isAutomatic(false);
  value.value = automatic ? value.automatic : number(expected);
  if (!automatic && value.value == value.automatic) fail(expected);
}

}  // namespace uncertainty_identification
