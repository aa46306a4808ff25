#include "ros/message_definition.h"

#include <algorithm>
#include <map>
#include <sstream>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

// Nesting and number of fields far above those of any real message, as a protection against
// malicious definitions.
constexpr int kMaxDepth = 50;
constexpr std::size_t kMaxVisited = 10000;  // fields that are listed at most, including nested ones
// [bytes] ROS states the size of a serialised message in 32 bits.
constexpr std::uint64_t kMaxSize = 1ULL << 32;
const char kHeader[] = "std_msgs/Header";

FieldType fieldType(const std::string& name) {
  static const std::map<std::string, FieldType> kBuiltin = {
      {"bool", FieldType::boolean},      {"int8", FieldType::int8},
      {"byte", FieldType::int8},         {"uint8", FieldType::uint8},
      {"char", FieldType::uint8},        {"int16", FieldType::int16},
      {"uint16", FieldType::uint16},     {"int32", FieldType::int32},
      {"uint32", FieldType::uint32},     {"int64", FieldType::int64},
      {"uint64", FieldType::uint64},     {"float32", FieldType::float32},
      {"float64", FieldType::float64},   {"time", FieldType::time},
      {"duration", FieldType::duration}, {"string", FieldType::string}};
  const auto found = kBuiltin.find(name);
  return found == kBuiltin.end() ? FieldType::message : found->second;
}

std::string packageOf(const std::string& type_name) {
  return type_name.substr(0, type_name.find('/'));
}

bool isSeparator(const std::string& line) {
  return line.size() >= 3 && line.find_first_not_of('=') == std::string::npos;
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// Splits "float64[9]" into the type and its array part.
void parseType(const std::string& text, MessageField& field) {
  const auto bracket = text.find('[');
  field.type_name = text.substr(0, bracket);
  field.type = fieldType(field.type_name);
  if (bracket == std::string::npos) return;
  if (text.back() != ']') throw DataError("'" + text + "' is not a type");
  const std::string length = text.substr(bracket + 1, text.size() - bracket - 2);
  field.array = length.empty() ? ArrayKind::variable : ArrayKind::fixed;
  if (length.find_first_not_of("0123456789") != std::string::npos || length.size() > 9)
    throw DataError("'" + text + "' is not an array of known length");
  if (!length.empty()) field.length = static_cast<std::uint32_t>(std::stoul(length));
}

}  // namespace

std::optional<std::uint64_t> builtinSize(FieldType type) {
  switch (type) {
    case FieldType::boolean:
    case FieldType::int8:
    case FieldType::uint8:
      return 1;
    case FieldType::int16:
    case FieldType::uint16:
      return 2;
    case FieldType::int32:
    case FieldType::uint32:
    case FieldType::float32:
      return 4;
    case FieldType::int64:
    case FieldType::uint64:
    case FieldType::float64:
    case FieldType::time:
    case FieldType::duration:
      return 8;
    case FieldType::string:
    case FieldType::message:
      break;
  }
  return std::nullopt;
}

MessageDefinition::MessageDefinition(const std::string& type_name, const std::string& text) {
  types_.push_back({type_name, {}, {}});
  try {
    parseBlocks(text);
    resolveTypes();
    std::vector<int> state(types_.size(), 0);
    measure(0, state, 0);
  } catch (const DataError& error) {
    throw DataError("the definition of message type '" + type_name +
                    "' cannot be read: " + error.what());
  }
}

void MessageDefinition::parseBlocks(const std::string& text) {
  std::istringstream stream(text);
  std::string line;
  bool name_follows = false;
  while (std::getline(stream, line)) {
    line = trimmed(line);
    if (isSeparator(line)) {
      name_follows = true;
    } else if (name_follows && !line.empty()) {
      if (line.compare(0, 5, "MSG: ") != 0)
        throw DataError("'" + line + "' was found where 'MSG: package/Type' is expected");
      types_.push_back({trimmed(line.substr(5)), {}, {}});
      name_follows = false;
    } else {
      parseLine(line, types_.back());
    }
  }
}

void MessageDefinition::parseLine(const std::string& line, MessageType& type) {
  const std::string declaration = trimmed(line.substr(0, line.find('#')));
  if (declaration.empty()) return;
  if (declaration.find('=') != std::string::npos) return;  // a constant is not serialised
  std::istringstream words(declaration);
  std::string type_text, name, more;
  if (!(words >> type_text >> name) || words >> more)
    throw DataError("'" + line + "' is not 'type name'");
  MessageField field;
  field.name = name;
  parseType(type_text, field);
  type.fields.push_back(field);
}

void MessageDefinition::resolveTypes() {
  for (auto& type : types_) {
    for (auto& field : type.fields) {
      if (field.type != FieldType::message) continue;
      field.message = findType(field.type_name, packageOf(type.name));
      field.type_name = types_[field.message].name;
    }
  }
}

std::size_t MessageDefinition::findType(const std::string& name, const std::string& package) const {
  const std::string full_name = name == "Header"                      ? kHeader
                                : name.find('/') == std::string::npos ? package + "/" + name
                                                                      : name;
  // The search begins behind the root, because a type cannot contain itself.
  for (std::size_t i = 1; i < types_.size(); ++i)
    if (types_[i].name == full_name) return i;
  throw DataError("type '" + full_name + "' is used but not defined");
}

// Computes the sizes by depth-first search. state: 0 not visited, 1 in progress, 2 done.
void MessageDefinition::measure(std::size_t index, std::vector<int>& state, int depth) {
  if (state[index] == 2) return;
  if (state[index] == 1 || depth > kMaxDepth)
    throw DataError("type '" + types_[index].name + "' is recursive or nested too deeply");
  state[index] = 1;
  std::optional<std::uint64_t> size = 0;
  for (const auto& field : types_[index].fields) {
    if (field.type == FieldType::message) measure(field.message, state, depth + 1);
    const auto field_size = serialisedSize(field);
    size = size && field_size ? std::optional(*size + *field_size) : std::nullopt;
    if (size && *size > kMaxSize) throw DataError("type '" + types_[index].name + "' is too large");
  }
  types_[index].serialised_size = size;
  state[index] = 2;
}

std::optional<std::uint64_t> MessageDefinition::elementSize(const MessageField& field) const {
  return field.type == FieldType::message ? contained(field).serialised_size
                                          : builtinSize(field.type);
}

std::optional<std::uint64_t> MessageDefinition::serialisedSize(const MessageField& field) const {
  const auto element = elementSize(field);
  if (field.array == ArrayKind::none) return element;
  if (field.array == ArrayKind::variable) return std::nullopt;
  if (field.length == 0) return 0;
  return element ? std::optional(*element * field.length) : std::nullopt;
}

bool MessageDefinition::hasHeader() const {
  const auto& fields = root().fields;
  return !fields.empty() && fields.front().type_name == kHeader &&
         fields.front().array == ArrayKind::none;
}

std::vector<std::string> MessageDefinition::numericFields(bool with_headers) const {
  std::vector<std::string> paths;
  std::size_t budget = kMaxVisited;
  listNumericFields(root(), "", with_headers, paths, budget);
  return paths;
}

void MessageDefinition::listNumericFields(const MessageType& type, const std::string& prefix,
                                          bool with_headers, std::vector<std::string>& paths,
                                          std::size_t& budget) const {
  for (const auto& field : type.fields) {
    if (budget == 0) return;
    --budget;
    const std::string path = prefix + field.name + (field.array == ArrayKind::none ? "" : "[0]");
    if (field.numeric()) {
      paths.push_back(path);
    } else if (field.type == FieldType::message && (with_headers || field.type_name != kHeader)) {
      listNumericFields(contained(field), path + ".", with_headers, paths, budget);
    }
  }
}

}  // namespace uncertainty_identification
