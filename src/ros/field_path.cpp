#include "ros/field_path.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "configuration/edit_distance.h"
#include "io/tree.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kListed = 15;  // number of fields that an error message lists

struct Component {
  std::string name;
  std::optional<std::uint32_t> index;
  std::string element;  // instead of the index

  bool isElement() const { return index.has_value() || !element.empty(); }
};

// What stands in the brackets: a number, or a name, which may be in quotes. No value for any other.
std::optional<Component> elementOf(const std::string& array, const std::string& inside) {
  if (inside.empty()) return std::nullopt;
  Component component{array, {}, {}};
  const bool quoted = inside.size() > 2 && inside.front() == inside.back() &&
                      (inside.front() == '\'' || inside.front() == '"');
  if (quoted)
    component.element = inside.substr(1, inside.size() - 2);
  else if (inside.find_first_not_of("0123456789") != std::string::npos)
    component.element = inside;
  else if (inside.size() > 9)
    return std::nullopt;
  else
    component.index = static_cast<std::uint32_t>(std::stoul(inside));
  return component;
}

// An element's name as the configuration has to write it: '7' is a name, 7 the eighth element.
std::string quoted(const std::string& element) {
  return element.find_first_not_of("0123456789") == std::string::npos ? "'" + element + "'"
                                                                      : element;
}

// "a.effort[left.wheel]" -> {"a"}, {"effort", "left.wheel"}; no value if the text does not have
// that form.
std::optional<std::vector<Component>> parsePath(const std::string& path) {
  std::vector<Component> components;
  std::size_t at = 0;
  for (bool more = true; more;) {
    std::size_t end = std::min(path.find_first_of(".[", at), path.size());
    std::optional<Component> component = Component{path.substr(at, end - at), {}, {}};
    if (end < path.size() && path[end] == '[') {
      const std::size_t close = path.find(']', end);
      if (close == std::string::npos) return std::nullopt;
      component = elementOf(component->name, path.substr(end + 1, close - end - 1));
      end = close + 1;
    }
    if (!component || component->name.empty()) return std::nullopt;
    components.push_back(*component);
    more = end < path.size();
    if (more && path[end] != '.') return std::nullopt;
    at = end + 1;
  }
  return components;
}

// "JointState" -> "joint_state"
std::string snakeCase(const std::string& name) {
  std::string result;
  for (const char c : name) {
    if (std::isupper(static_cast<unsigned char>(c)) && !result.empty()) result += '_';
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return result;
}

std::string lastPart(const std::string& name) { return name.substr(name.find_last_of('/') + 1); }

// Lists the fields. Those whose path ends in the wanted path come first, the others follow in order
// of their edit distance to it.
std::string listFields(const MessageDefinition& definition, const std::string& wanted) {
  auto fields = definition.numericFields(false);
  if (fields.empty()) return "it has no numeric field";
  const auto distance = [&wanted](const std::string& field) {
    const bool same_end = field.size() > wanted.size() && !wanted.empty() &&
                          field.compare(field.size() - wanted.size(), wanted.size(), wanted) == 0;
    return same_end ? 0 : 1 + editDistance(field, wanted);
  };
  if (!wanted.empty())
    std::stable_sort(fields.begin(), fields.end(),
                     [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  std::string list = "its numeric fields are ";
  for (std::size_t i = 0; i < std::min(kListed, fields.size()); ++i)
    list += (i == 0 ? "'" : ", '") + fields[i] + "'";
  if (fields.size() > kListed) list += " and " + std::to_string(fields.size() - kListed) + " more";
  return list;
}

// Follows the components from `first` on, starting at the root. No value if they do not lead to a
// number.
std::optional<FieldPath> follow(const MessageDefinition& definition,
                                const std::vector<Component>& components, std::size_t first) {
  FieldPath path;
  const MessageType* type = &definition.root();
  for (std::size_t i = first; i < components.size(); ++i) {
    const auto& component = components[i];
    if (type == nullptr) return std::nullopt;
    const auto field = std::find_if(type->fields.begin(), type->fields.end(),
                                    [&](const auto& f) { return f.name == component.name; });
    if (field == type->fields.end()) return std::nullopt;
    if ((field->array != ArrayKind::none) != component.isElement()) return std::nullopt;
    const std::uint32_t index = component.index.value_or(0);
    if (field->array == ArrayKind::fixed && index >= field->length) return std::nullopt;
    const auto names = namesField(*type);
    if (!component.element.empty() && !names) return std::nullopt;
    const bool last = i + 1 == components.size();
    if (last != field->numeric()) return std::nullopt;
    path.steps.push_back({static_cast<std::size_t>(field - type->fields.begin()), index,
                          component.element, component.element.empty() ? 0 : *names});
    path.text += (path.text.empty() ? "" : ".") + component.name;
    if (component.isElement())
      path.text +=
          "[" + (component.index ? std::to_string(index) : quoted(component.element)) + "]";
    type = field->type == FieldType::message ? &definition.contained(*field) : nullptr;
  }
  return path.steps.empty() ? std::nullopt : std::optional(path);
}

FieldPath resolveAutomatic(const MessageDefinition& definition, const std::string& topic) {
  const auto fields = definition.numericFields(false);
  if (fields.size() == 1) {
    const auto path = follow(definition, *parsePath(fields.front()), 0);
    if (path && fields.front().find('[') == std::string::npos) return *path;
  }
  throw ConfigurationError(
      "topic '" + topic + "' of type " + definition.root().name +
      ": field: auto needs exactly one numeric field that is not an array, but " +
      listFields(definition, "") + "; name one of them under 'field'");
}

// What the message of an error adds for a path that names an element.
std::string aboutNames(const std::optional<std::vector<Component>>& components) {
  const bool names_one =
      components && std::any_of(components->begin(), components->end(),
                                [](const Component& each) { return !each.element.empty(); });
  return names_one ? "; an element can be called by its name only where the message has an array "
                     "'name' (string[]) beside the array, otherwise write its number"
                   : "";
}

}  // namespace

std::optional<std::size_t> namesField(const MessageType& type) {
  for (std::size_t i = 0; i < type.fields.size(); ++i) {
    const MessageField& field = type.fields[i];
    const bool is_list = field.type == FieldType::string && field.array == ArrayKind::variable;
    if (is_list && field.name == "name") return i;
  }
  return std::nullopt;
}

FieldPath resolveFieldPath(const MessageDefinition& definition, const std::string& path,
                           const std::string& topic) {
  if (path == "auto") return resolveAutomatic(definition, topic);
  const auto components = parsePath(path);
  if (components) {
    if (const auto found = follow(definition, *components, 0)) return *found;
    const std::string alias = components->empty() ? "" : components->front().name;
    if (alias == lastPart(topic) || alias == snakeCase(lastPart(definition.root().name)))
      if (const auto found = follow(definition, *components, 1)) return *found;
  }
  throw ConfigurationError("topic '" + topic + "' of type " + definition.root().name +
                           " has no numeric field '" + path + "'; " + listFields(definition, path) +
                           aboutNames(components));
}

}  // namespace uncertainty_identification
